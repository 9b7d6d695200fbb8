#pragma once
/// The HDF5 library with handles that close themselves. Only the files of io that read and write HDF5 include this.

#include <hdf5.h>

#include <cstddef>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace spindrift::hdf5 {

/// What a refusal of the library throws; callers turn it into an Error.
struct Refused {
  std::string what;
};

template <class T>
T checked(T result, const char* what) {
  if (result < 0) throw Refused{what};
  return result;
}

/// An identifier and the call that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const char* what) : id_(checked(id, what)), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor)

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// One at a time may use the library (its thread-safe build would do the same), without its printing of errors.
class Session {
 public:
  Session() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Session() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

/// The type of T in memory and, little-endian, in files.
template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_STD_U8LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
}

inline Handle property_list(hid_t kind) {
  return {H5Pcreate(kind), H5Pclose, "create a property list"};
}

inline Handle space(std::span<const hsize_t> shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "create a dataspace"};
}

}  // namespace spindrift::hdf5
