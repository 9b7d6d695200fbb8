// The plan of the house, held against the code: who may include whom, and where each package lives.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = SPINDRIFT_SOURCE_DIR;

/// What each folder may include besides itself.
const std::map<std::string, std::set<std::string>> allowed{
    {"core", {}},
    {"terrain", {"core"}},
    {"io", {"core"}},
    {"gdal", {"core", "io"}},
    {"openvdb", {"core", "io"}},
    {"sph", {"core", "terrain"}},
    {"grid", {"core", "terrain"}},
    {"coupling", {"core", "terrain", "sph", "grid"}},
    {"entrainment", {"core", "terrain", "sph"}},
    {"simulation", {"core", "terrain", "io", "sph", "grid", "coupling", "entrainment"}},
    {"verification", {"core", "terrain", "io", "sph", "grid", "coupling", "entrainment", "simulation"}},
};

/// The one place of each package, as the beginning of a path under the root.
const std::map<std::string, std::string> homes{
    {"hdf5.h", "src/io/"},
    {"cairo/", "src/io/"},
    {"xxhash.h", "src/io/"},
    {"gdal", "src/gdal/"},
    {"openvdb/", "src/openvdb/"},
    {"nanoflann", "src/sph/kd_tree.hpp"},
    {"CLI/", "apps/"},
    {"toml++/", "src/simulation/toml_document.cpp"},
    {"oneapi/tbb", "src/core/parallel"},
    {"Random123/", "src/core/random.cpp"},
};

std::vector<fs::path> sources(const char* folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp") files.push_back(entry.path());
  return files;
}

/// Calls f(what stands between the quotes or angles) for every include.
template <class F>
void for_each_include(const fs::path& path, F&& f) {
  static const std::regex include(R"rx(^\s*#include\s*[<"]([^>"]+)[>"])rx");
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::smatch match;
    if (std::regex_search(line, match, include)) f(match[1].str());
  }
}

}  // namespace

TEST_CASE("A folder includes only what stands below it", "[structure]") {
  for (const fs::path& path : sources("src")) {
    const std::string folder = path.parent_path().filename();
    REQUIRE(allowed.contains(folder));
    for_each_include(path, [&](const std::string& name) {
      const std::string from = name.substr(0, name.find('/'));
      CAPTURE(path.string(), name);
      if (allowed.contains(from)) CHECK((from == folder || allowed.at(folder).contains(from)));
    });
  }
}

TEST_CASE("A package has one home", "[structure]") {
  for (const char* folder : {"src", "apps"})
    for (const fs::path& path : sources(folder)) {
      const std::string place = fs::relative(path, root).string();
      for_each_include(path, [&](const std::string& name) {
        for (const auto& [package, home] : homes) {
          CAPTURE(place, name);
          if (name.starts_with(package)) CHECK(place.starts_with(home));
        }
      });
    }
}

TEST_CASE("Files can be held in the head", "[structure]") {
  for (const char* folder : {"src", "apps"})
    for (const fs::path& path : sources(folder)) {
      std::ifstream file(path);
      std::size_t lines = 0;
      for (std::string line; std::getline(file, line);) ++lines;
      CAPTURE(path.string());
      CHECK(lines <= 350);
    }
}
