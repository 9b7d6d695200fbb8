#include <algorithm>

#include "core/error.hpp"
#include "io/hdf5.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtkhdf_format.hpp"

namespace spindrift {

using namespace hdf5;

namespace {

/// Deflate cannot shrink by more; a file that claims more values than that has none of them.
constexpr hsize_t largest_compression = 1032;
constexpr hsize_t most_points = hsize_t{1} << 40;  ///< keeps sizes in bytes within 64 bits

Handle open_bytes(std::span<const std::byte> bytes) {
  const Handle access = property_list(H5P_FILE_ACCESS);
  checked(H5Pset_fapl_core(access, std::size_t{1} << 20, 0), "choose memory");
  checked(H5Pset_file_image(access, const_cast<std::byte*>(bytes.data()), bytes.size()), "take the file");
  // HDF5 refuses an image whose name is that of a file on disk, so it gets one that no file can have.
  return {H5Fopen("/dev/null/frame", H5F_ACC_RDONLY, access), H5Fclose, "not an HDF5 file"};
}

/// Only hard links: the others may lead out of the file.
void expect_hard_link(hid_t parent, const char* name) {
  H5L_info_t info;
  checked(H5Lget_info(parent, name, &info, H5P_DEFAULT), name);
  if (info.type != H5L_TYPE_HARD) throw Refused{std::string(name) + " is not in the file itself"};
}

Handle open_group(hid_t parent, const char* name) {
  expect_hard_link(parent, name);
  return {H5Gopen2(parent, name, H5P_DEFAULT), H5Gclose, name};
}

std::vector<std::string> link_names(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list a group");
  return names;
}

Handle open_attribute(hid_t object, const char* name) {
  return {H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name};
}

template <class T, std::size_t n>
std::array<T, n> read_numbers(hid_t object, const char* name) {
  const Handle attribute = open_attribute(object, name);
  const Handle where(H5Aget_space(attribute), H5Sclose, name), type(H5Aget_type(attribute), H5Tclose, name);
  if (H5Sget_simple_extent_npoints(where) != static_cast<hssize_t>(n) || H5Tequal(type, type_of<T>()) <= 0)
    throw Refused{std::string(name) + " has another type or length"};
  std::array<T, n> values;
  checked(H5Aread(attribute, type_of<T>(), values.data()), name);
  return values;
}

std::string read_text(hid_t object, const char* name) {
  const Handle attribute = open_attribute(object, name);
  const Handle type(H5Aget_type(attribute), H5Tclose, name);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw Refused{std::string(name) + " is not a string of fixed length"};
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()), name);
  text.erase(std::ranges::find(text, '\0'), text.end());
  return text;
}

void expect_known_filters(hid_t dataset, const std::string& name) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose, name.c_str());
  for (int i = 0, n = checked(H5Pget_nfilters(creation), name.c_str()); i < n; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t n_values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &n_values, nullptr, 0, nullptr, &config);
    if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE) throw Refused{name + " has a filter of others"};
  }
  if (H5Pget_external_count(creation) != 0 || H5Pget_layout(creation) == H5D_VIRTUAL)
    throw Refused{name + " is not in the file itself"};
}

/// n_point_axes: axes before that of the components, if there is one.
StoredArray read_array(hid_t group, const std::string& name, int n_point_axes, hsize_t n_points) {
  expect_hard_link(group, name.c_str());
  const Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name.c_str());
  expect_known_filters(dataset, name);
  const Handle where(H5Dget_space(dataset), H5Sclose, name.c_str());
  const Handle type(H5Dget_type(dataset), H5Tclose, name.c_str());
  const int rank = H5Sget_simple_extent_ndims(where);
  if (rank != n_point_axes && rank != n_point_axes + 1) throw Refused{name + " has another rank"};
  std::array<hsize_t, 4> shape{1, 1, 1, 1};
  checked(H5Sget_simple_extent_dims(where, shape.data(), nullptr), name.c_str());
  const hsize_t components = rank > n_point_axes ? shape[static_cast<std::size_t>(n_point_axes)] : 1;
  hsize_t n = 1;
  for (int axis = 0; axis < n_point_axes; ++axis) n *= shape[static_cast<std::size_t>(axis)];
  if (n != n_points || n > most_points || components < 1 || components > 9) throw Refused{name + " has another shape"};
  const hsize_t n_bytes = n * components * H5Tget_size(type);
  if (n_bytes > (H5Dget_storage_size(dataset) + 64) * largest_compression) throw Refused{name + " has no values"};

  StoredArray array{name, static_cast<int>(components), {}};
  const auto read_as = [&]<class T>(T) {
    if (H5Tequal(type, type_of<T>()) <= 0) return false;
    std::vector<T> values(n * components);
    if (n > 0) checked(H5Dread(dataset, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name.c_str());
    array.values = std::move(values);
    return true;
  };
  if (!(read_as(float{}) || read_as(double{}) || read_as(std::uint8_t{}) || read_as(std::int64_t{})))
    throw Refused{name + " has another type"};
  return array;
}

Attributes read_attributes(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  checked(H5Aiterate2(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list the attributes");
  Attributes attributes;
  for (const std::string& name : names) {
    if (name == "format") continue;
    const Handle attribute = open_attribute(group, name.c_str());
    const Handle type(H5Aget_type(attribute), H5Tclose, name.c_str());
    switch (H5Tget_class(type)) {
      case H5T_STRING:
        attributes.push_back({name, read_text(group, name.c_str())});
        break;
      case H5T_FLOAT:
        attributes.push_back({name, read_numbers<double, 1>(group, name.c_str())[0]});
        break;
      default:
        attributes.push_back({name, read_numbers<std::int64_t, 1>(group, name.c_str())[0]});
    }
  }
  return attributes;
}

StoredFrame read_frame(std::span<const std::byte> bytes) {
  const Handle file = open_bytes(bytes);
  const Handle own = open_group(file, vtkhdf::own_group), root = open_group(file, vtkhdf::root_group);
  const auto version = read_numbers<std::int64_t, 2>(own, "format");
  if (version[0] != vtkhdf::format_version[0])
    throw Refused{"format " + std::to_string(version[0]) + "." + std::to_string(version[1]) + ", this program reads " +
                  std::to_string(vtkhdf::format_version[0]) + ".x"};
  StoredFrame frame{{}, {}, read_attributes(own)};
  const Handle point_data = open_group(root, vtkhdf::point_data);
  hsize_t n_points = 0;
  int n_point_axes = 1;
  if (const std::string type = read_text(root, "Type"); type == vtkhdf::point_cloud) {
    const StoredArray count = read_array(root, "NumberOfPoints", 1, 1);
    const auto* values = std::get_if<std::vector<std::int64_t>>(&count.values);
    if (values == nullptr || values->front() < 0) throw Refused{"NumberOfPoints is not a count"};
    n_points = static_cast<hsize_t>(values->front());
    frame.arrays.push_back(read_array(root, vtkhdf::positions, n_point_axes, n_points));
  } else if (type == vtkhdf::lattice_image) {
    const auto extent = read_numbers<std::int64_t, 6>(root, "WholeExtent");
    Lattice lattice{{}, read_numbers<double, 3>(root, "Origin"), read_numbers<double, 3>(root, "Spacing")};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (extent[2 * axis] != 0 || extent[2 * axis + 1] < 0 || extent[2 * axis + 1] > (1 << 20))
        throw Refused{"WholeExtent is not one of ours"};
      lattice.shape[axis] = extent[2 * axis + 1] + 1;
    }
    frame.lattice = lattice;
    n_points = lattice.n_points();
    n_point_axes = 3;
  } else {
    throw Refused{"of the type " + type};
  }
  for (const std::string& name : link_names(point_data))
    frame.arrays.push_back(read_array(point_data, name, n_point_axes, n_points));
  std::ranges::sort(frame.arrays, {}, &StoredArray::name);

  std::vector<NamedArray> views;
  for (const StoredArray& array : frame.arrays) views.push_back(array.view());
  if (frame_digest(frame.lattice, views) != read_text(own, "digest")) throw Refused{"its digest does not hold"};
  return frame;
}

}  // namespace

StoredFrame read_vtkhdf(std::span<const std::byte> bytes, const std::string& name) {
  const Session session;
  try {
    return read_frame(bytes);
  } catch (const Refused& refused) {
    throw Error(ExitCode::incompatible_file, name + " is not a frame that can be read: " + refused.what);
  }
}

}  // namespace spindrift
