#pragma once
/// Parts that need a large package, as shared libraries of their own: a run that needs none of them pays for none.
/// A module is handed what it works on, and uses of src/core and src/io only what their headers hold.

#include <string>

namespace spindrift {

/// Loads a module that stands beside the program, the first time it is asked for; it stays.
/// file     its name, as "spindrift_gdal.so"
/// asker    what needs it, for messages
/// Returns its interface: the object that it calls `spindrift_module`.   Throws Error(bad_input): it does not load.
const void* load_module(const char* file, const std::string& asker);

/// Interface    a struct of pointers to functions, with the `file` that holds them
template <class Interface>
const Interface& load_module(const std::string& asker) {
  return *static_cast<const Interface*>(load_module(Interface::file, asker));
}

}  // namespace spindrift
