#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/error.hpp"
#include "io/digest.hpp"
#include "io/hdf5.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtkhdf_format.hpp"

namespace spindrift {

using namespace hdf5;

std::string frame_digest(const std::optional<Lattice>& lattice, std::span<const NamedArray> sorted_arrays) {
  Digest digest;
  if (lattice)
    digest.add(std::span<const std::int64_t>(lattice->shape))
        .add(std::span<const double>(lattice->origin))
        .add(std::span<const double>(lattice->spacing));
  for (const NamedArray& array : sorted_arrays) {
    digest.add(array.name).add(array.components).add(array.values.index());
    std::visit([&](const auto& values) { digest.add(values); }, array.values);
  }
  return digest.hex();
}

namespace {

constexpr hsize_t chunk_rows = 16384;

/// A file in memory that never touches a disk.
class MemoryFile {
 public:
  MemoryFile() : file_(create()) {}
  operator hid_t() const { return file_; }  // NOLINT(google-explicit-constructor)

  std::vector<std::byte> bytes() const {
    checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush the file");
    std::vector<std::byte> image(static_cast<std::size_t>(checked(H5Fget_file_image(file_, nullptr, 0), "measure")));
    checked(H5Fget_file_image(file_, image.data(), image.size()), "take the file");
    return image;
  }

 private:
  static Handle create() {
    const Handle access = property_list(H5P_FILE_ACCESS), creation = property_list(H5P_FILE_CREATE);
    checked(H5Pset_fapl_core(access, std::size_t{1} << 20, 0), "choose memory");
    checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "choose the format");
    checked(H5Pset_obj_track_times(creation, false), "switch times off");
    return {H5Fcreate("spindrift", H5F_ACC_TRUNC, creation, access), H5Fclose, "create the file"};
  }
  Handle file_;
};

Handle create_group(hid_t parent, const char* name) {
  const Handle creation = property_list(H5P_GROUP_CREATE);
  checked(H5Pset_obj_track_times(creation, false), "switch times off");
  checked(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED), "choose the newer header");
  checked(H5Pset_attr_phase_change(creation, 0, 0), "allow long attributes");
  return {H5Gcreate2(parent, name, H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, "create a group"};
}

template <class T>
void write_attribute(hid_t object, const char* name, std::span<const T> values, bool scalar = false) {
  const hsize_t n = values.size();
  const Handle where = scalar ? Handle(H5Screate(H5S_SCALAR), H5Sclose, "create a dataspace") : space({&n, 1});
  const Handle attribute(H5Acreate2(object, name, type_of<T>(), where, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  checked(H5Awrite(attribute, type_of<T>(), values.data()), name);
}

void write_attribute(hid_t object, const char* name, const std::string& text, H5T_cset_t set) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a string type");
  checked(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)), "size a string");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "pad a string");
  checked(H5Tset_cset(type, set), "choose the alphabet");
  const Handle where(H5Screate(H5S_SCALAR), H5Sclose, "create a dataspace");
  const Handle attribute(H5Acreate2(object, name, type, where, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  checked(H5Awrite(attribute, type, text.c_str()), name);
}

/// Chunks of about chunk_rows points, whole rows along the fast axes first.
std::vector<hsize_t> chunk_of(std::span<const hsize_t> shape, std::size_t n_point_axes) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  hsize_t room = chunk_rows;
  for (std::size_t axis = n_point_axes; axis-- > 0;) {
    chunk[axis] = std::clamp<hsize_t>(room, 1, shape[axis]);
    room /= chunk[axis];
  }
  return chunk;
}

/// shape: slowest axis first, n_point_axes axes of points and perhaps one of components.
template <class T>
void write_dataset(hid_t group, const std::string& name, std::span<const T> values, std::span<const hsize_t> shape,
                   std::size_t n_point_axes) {
  const Handle creation = property_list(H5P_DATASET_CREATE);
  checked(H5Pset_obj_track_times(creation, false), "switch times off");
  if (values.size() > 1) {
    const std::vector<hsize_t> chunk = chunk_of(shape, n_point_axes);
    checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "choose chunks");
    checked(H5Pset_shuffle(creation), "choose shuffling");
    checked(H5Pset_deflate(creation, 1), "choose compression");
  }
  const Handle where = space(shape);
  const Handle data(H5Dcreate2(group, name.c_str(), type_of<T>(), where, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                    name.c_str());
  if (!values.empty())
    checked(H5Dwrite(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name.c_str());
}

template <class T>
void write_list(hid_t group, const std::string& name, std::span<const T> values) {
  const hsize_t n = values.size();
  write_dataset(group, name, values, {&n, 1}, 1);
}

/// shape: of the points, slowest axis first.
void write_array(hid_t group, const NamedArray& array, std::span<const hsize_t> shape) {
  std::vector<hsize_t> full(shape.begin(), shape.end());
  if (array.components > 1) full.push_back(static_cast<hsize_t>(array.components));
  std::visit([&](const auto& values) { write_dataset(group, array.name, values, full, shape.size()); }, array.values);
}

/// The arrays as files hold them, sorted by name: (x, z) becomes (x, 0, z), and each run of `row` points stands
/// `copies` times. What needs neither is not copied.
class ArraysToStore {
 public:
  ArraysToStore(std::span<const NamedArray> arrays, std::size_t n_points, std::size_t row, int copies) {
    owned_.reserve(arrays.size());
    for (const NamedArray& array : arrays) {
      if (array.components < 1 || array.n_values() != n_points * static_cast<std::size_t>(array.components))
        throw Error(ExitCode::bug, "array " + array.name + " does not fit its points");
      views_.push_back(array.components == 2 || copies > 1 ? expanded(array, row, copies) : array);
    }
    std::ranges::sort(views_, {}, &NamedArray::name);
    if (std::ranges::adjacent_find(views_, {}, &NamedArray::name) != views_.end())
      throw Error(ExitCode::bug, "two arrays of a frame have the same name");
  }
  std::span<const NamedArray> all() const { return views_; }

 private:
  NamedArray expanded(const NamedArray& array, std::size_t row, int copies) {
    const std::size_t c = static_cast<std::size_t>(array.components);
    owned_.push_back({array.name, c == 2 ? 3 : array.components, {}});
    std::visit(
        [&](auto from) {
          std::vector<typename decltype(from)::value_type> to;
          to.reserve(from.size() / c * static_cast<std::size_t>(owned_.back().components * copies));
          for (; !from.empty(); from = from.subspan(row * c))
            for (int copy = 0; copy < copies; ++copy)
              for (std::size_t k = 0; k < row * c; ++k) {
                if (c == 2 && k % 2 == 1) to.push_back({});
                to.push_back(from[k]);
              }
          owned_.back().values = std::move(to);
        },
        array.values);
    return owned_.back().view();
  }

  std::vector<StoredArray> owned_;
  std::vector<NamedArray> views_;
};

void write_attributes(hid_t file, const Attributes& attributes, const std::string& digest) {
  const Handle group = create_group(file, vtkhdf::own_group);
  write_attribute<std::int64_t>(group, "format", vtkhdf::format_version);
  write_attribute(group, "digest", digest, H5T_CSET_ASCII);
  for (const Attribute& attribute : attributes) {
    const char* name = attribute.name.c_str();
    if (const auto* text = std::get_if<std::string>(&attribute.value)) {
      write_attribute(group, name, *text, H5T_CSET_UTF8);
    } else if (const auto* number = std::get_if<double>(&attribute.value)) {
      write_attribute<double>(group, name, {number, 1}, true);
    } else {
      write_attribute<std::int64_t>(group, name, {&std::get<std::int64_t>(attribute.value), 1}, true);
    }
  }
}

Handle create_root(hid_t file, const std::string& type) {
  Handle root = create_group(file, vtkhdf::root_group);
  write_attribute<std::int64_t>(root, "Version", vtkhdf::vtk_version);
  write_attribute(root, "Type", type, H5T_CSET_ASCII);
  return root;
}

/// build(), with what the library or the memory refuses told as an Error.
template <class F>
std::vector<std::byte> told(F&& build) {
  const Session session;
  try {
    return build();
  } catch (const Refused& refused) {
    throw Error(ExitCode::io_failed, "HDF5 could not build a frame: " + refused.what);
  }
}

}  // namespace

std::vector<std::byte> vtkhdf_bytes(const PointCloud& cloud) {
  const std::size_t n = cloud.n_points();
  std::vector<NamedArray> inputs = cloud.arrays;
  inputs.push_back({vtkhdf::positions, cloud.positions.components, cloud.positions.values});
  const ArraysToStore arrays(inputs, n, n, 1);
  std::vector<std::int64_t> numbers(n + 1);
  std::iota(numbers.begin(), numbers.end(), 0);

  return told([&] {
    const MemoryFile file;
    const Handle root = create_root(file, vtkhdf::point_cloud);
    const std::int64_t count = static_cast<std::int64_t>(n);
    for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
      write_list<std::int64_t>(root, name, {&count, 1});
    write_list<std::int64_t>(root, "Connectivity", std::span(numbers).first(n));
    write_list<std::int64_t>(root, "Offsets", numbers);
    write_list<std::uint8_t>(root, "Types", std::vector<std::uint8_t>(n, vtkhdf::vertex));
    const Handle point_data = create_group(root, vtkhdf::point_data);
    const hsize_t shape = n;
    for (const NamedArray& array : arrays.all())
      write_array(array.name == vtkhdf::positions ? root : point_data, array, {&shape, 1});
    write_attributes(file, cloud.attributes, frame_digest({}, arrays.all()));
    return file.bytes();
  });
}

std::vector<std::byte> vtkhdf_bytes(const LatticeImage& image) {
  const int layers = image.lattice.shape[1] == 1 ? 2 : 1;
  const ArraysToStore arrays(image.arrays, image.lattice.n_points(), static_cast<std::size_t>(image.lattice.shape[0]),
                             layers);
  Lattice lattice = image.lattice;
  if (layers == 2) {
    lattice.shape[1] = 2;
    lattice.origin[1] = 0;
    lattice.spacing[1] = 1;
  }

  return told([&] {
    const MemoryFile file;
    const Handle root = create_root(file, vtkhdf::lattice_image);
    const auto [nx, ny, nz] = lattice.shape;
    write_attribute<std::int64_t>(root, "WholeExtent", std::array<std::int64_t, 6>{0, nx - 1, 0, ny - 1, 0, nz - 1});
    write_attribute<double>(root, "Origin", lattice.origin);
    write_attribute<double>(root, "Spacing", lattice.spacing);
    write_attribute<double>(root, "Direction", std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    const Handle point_data = create_group(root, vtkhdf::point_data);
    const std::array<hsize_t, 3> shape{static_cast<hsize_t>(nz), static_cast<hsize_t>(ny), static_cast<hsize_t>(nx)};
    for (const NamedArray& array : arrays.all()) write_array(point_data, array, shape);
    write_attributes(file, image.attributes, frame_digest(lattice, arrays.all()));
    return file.bytes();
  });
}

}  // namespace spindrift
