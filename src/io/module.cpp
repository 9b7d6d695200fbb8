#include "io/module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace spindrift {

const void* load_module(const char* file, const std::string& asker) {
  // A bare name is looked up along the program's RUNPATH; a module that is there already is only counted again.
  void* const module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  const void* const interface = module == nullptr ? nullptr : dlsym(module, "spindrift_module");
  if (interface == nullptr)
    throw Error(ExitCode::bad_input, fmt::format("{} needs {}, which does not load: {}", asker, file, dlerror()));
  return interface;
}

}  // namespace spindrift
