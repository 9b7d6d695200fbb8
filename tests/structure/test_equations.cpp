// The pages of docs, held against the code: what they name is there, under that name.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = SPINDRIFT_SOURCE_DIR;
constexpr int n_paper_equations = 16;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// README, CONTRIBUTING and every page of docs/.
std::vector<fs::path> pages() {
  std::vector<fs::path> all{root / "README.md", root / "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  return all;
}

/// Calls f(match) for every match of `pattern` in `text`.
template <class F>
void for_each_match(const std::string& text, const std::regex& pattern, F&& f) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) f(*match);
}

/// `file`: `function`, or `file`: "test case".
struct Reference {
  std::string file, name;
};

std::vector<Reference> references(const std::string& cell, const char* pattern) {
  std::vector<Reference> all;
  for_each_match(cell, std::regex(pattern), [&](const std::smatch& m) { all.push_back({m[1], m[2]}); });
  return all;
}

/// A row of a table of docs/equations.md: equation | what it is | function | test.
struct Row {
  std::string line;
  std::vector<std::string> cells;
  std::vector<Reference> functions() const { return references(cells.at(2), R"rx(`([^`]+)`: `([^`]+)`)rx"); }
  std::vector<Reference> tests() const { return references(cells.at(3), R"rx(`([^`]+)`: "([^"]+)")rx"); }
};

std::vector<Row> rows() {
  std::vector<Row> all;
  for (const std::string& line : lines_of(root / "docs" / "equations.md")) {
    if (!line.starts_with("|") || line.starts_with("| equation |") || line.starts_with("| ---")) continue;
    Row row{line, {}};
    for_each_match(line.substr(1), std::regex(R"rx(\s*([^|]*?)\s*\|)rx"),
                   [&](const std::smatch& m) { row.cells.push_back(m[1]); });
    all.push_back(row);
  }
  return all;
}

/// Whether a file defines or declares `name`, "function" or "Class::function". Code is formatted, so a line that begins
/// in column 0 stands at namespace level: what calls a function is indented.
bool holds_function(const fs::path& path, const std::string& name) {
  const std::size_t colons = name.find("::");
  const std::string function = colons == std::string::npos ? name : name.substr(colons + 2);
  const std::string owner = colons == std::string::npos ? "" : name.substr(0, colons);
  const bool in_class = path.extension() == ".hpp" && !owner.empty();
  const std::regex class_line("^(class|struct) " + owner + "\\b");
  const std::regex pattern(in_class ? "^  [A-Za-z].*\\b" + function + "\\("
                                    : "^[A-Za-z][^=;]*\\b" + (owner.empty() ? "" : owner + "(<[^()]*>)?::") + function +
                                          "(<[^()]*>)?\\(");
  bool inside = !in_class;
  for (const std::string& line : lines_of(path)) {
    if (in_class && std::regex_search(line, class_line)) inside = true;
    if (in_class && line.starts_with("}")) inside = false;
    if (inside && std::regex_search(line, pattern)) return true;
  }
  return false;
}

/// The names of a test file's cases, their pieces joined.
std::set<std::string> test_cases(const fs::path& path) {
  static const std::regex heading(R"rx((TEST_CASE|TEMPLATE_TEST_CASE_SIG)\(\s*(("([^"\\]|\\.)*"\s*)+))rx");
  std::set<std::string> names;
  const std::string text = text_of(path);
  for_each_match(text, heading, [&](const std::smatch& m) {
    std::string name;
    for_each_match(m[2], std::regex(R"rx("(([^"\\]|\\.)*)")rx"), [&](const std::smatch& piece) { name += piece[1]; });
    names.insert(name);
  });
  return names;
}

/// The text without code, where brackets are no links.
std::string without_code(const std::string& text) {
  static const std::regex code(R"rx(`[^`\n]*`)rx");
  std::string prose;
  bool fenced = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      fenced = !fenced;
    else if (!fenced)
      prose += std::regex_replace(line, code, "") + "\n";
  }
  return prose;
}

}  // namespace

TEST_CASE("Every equation of the paper has a row in docs/equations.md", "[docs]") {
  std::set<std::string> named;
  for (const Row& row : rows()) named.insert(row.cells.at(0).substr(0, row.cells.at(0).find(' ')));
  for (int k = 1; k <= n_paper_equations; ++k) {
    CAPTURE(k);
    CHECK(named.contains("(" + std::to_string(k) + ")"));
  }
}

TEST_CASE("Every row of docs/equations.md names a function and a test that exist", "[docs]") {
  const std::vector<Row> all = rows();
  REQUIRE(all.size() > n_paper_equations);
  for (const Row& row : all) {
    CAPTURE(row.line);
    REQUIRE(row.cells.size() == 4);
    CHECK(!row.functions().empty());
    CHECK(!row.tests().empty());
    for (const auto& [file, name] : row.functions()) {
      CAPTURE(file, name);
      CHECK(fs::is_regular_file(root / "src" / file));
      CHECK(holds_function(root / "src" / file, name));
    }
    for (const auto& [file, name] : row.tests()) {
      CAPTURE(file, name);
      CHECK(fs::is_regular_file(root / "tests" / file));
      CHECK(test_cases(root / "tests" / file).contains(name));
    }
    // Nothing else stands in these cells: a reference with a slip in its form would go unchecked.
    for (const std::size_t k : {2, 3}) {
      const std::regex form(k == 2 ? R"rx(`[^`]+`: `[^`]+`)rx" : R"rx(`[^`]+`: "[^"]+"( \(indirect\))?)rx");
      CHECK(std::regex_replace(row.cells[k], form, "").find_first_not_of(" ,") == std::string::npos);
    }
  }
}

TEST_CASE("Every relative link of the pages leads to a file", "[docs]") {
  static const std::regex link(R"rx(\]\(([^)\s]+)[^)]*\))rx");
  int n_links = 0;
  for (const fs::path& page : pages()) {
    for_each_match(without_code(text_of(page)), link, [&](const std::smatch& m) {
      const std::string target = m[1].str().substr(0, m[1].str().find('#'));
      if (target.empty() || target.find("://") != std::string::npos || target.starts_with("mailto:")) return;
      CAPTURE(page.string(), target);
      CHECK(fs::exists(page.parent_path() / target));
      ++n_links;
    });
  }
  CHECK(n_links > 0);
}

TEST_CASE("Every scene file that the pages name exists", "[docs]") {
  static const std::regex scene(R"rx(configs/[A-Za-z0-9_/.-]*\.toml)rx");
  int n_scenes = 0;
  for (const fs::path& page : pages()) {
    for_each_match(text_of(page), scene, [&](const std::smatch& m) {
      CAPTURE(page.string(), m.str());
      CHECK(fs::is_regular_file(root / m.str()));
      ++n_scenes;
    });
  }
  CHECK(n_scenes > 0);
}

TEST_CASE("Every path of the sources that the pages name in code exists", "[docs]") {
  static const std::regex path(R"rx(`((src|apps|tests|configs|cmake|benchmarks|docs)/[A-Za-z0-9_/.-]*)`)rx");
  int n_paths = 0;
  for (const fs::path& page : pages()) {
    for_each_match(text_of(page), path, [&](const std::smatch& m) {
      CAPTURE(page.string(), m.str());
      CHECK(fs::exists(root / m[1].str()));
      ++n_paths;
    });
  }
  CHECK(n_paths > 0);
}

TEST_CASE("Every scene key that the pages name in code is in the registry", "[docs]") {
  static const std::regex key(
      R"rx(`((scene|domain|terrain|release|dense_flow|cover|suspension|coupling|entrainment|output)(\.[a-z_]+)*)\.([a-z_]+)( = [^`]*)?`)rx");
  std::string registry;
  for (const auto& entry : fs::directory_iterator(root / "src" / "simulation"))
    if (entry.path().extension() == ".cpp") registry += text_of(entry.path());
  const auto registered = [&](const std::string& name) { return registry.find('"' + name + '"') != std::string::npos; };
  int n_keys = 0;
  for (const fs::path& page : pages()) {
    for_each_match(text_of(page), key, [&](const std::smatch& m) {
      if (m[4] == "toml" || m[4] == "hpp" || m[4] == "cpp") return;
      CAPTURE(page.string(), m.str());
      CHECK((registered(m[1]) || registered(m[1].str() + "." + m[4].str())));
      CHECK((registered(m[4]) || registered(m[1].str() + "." + m[4].str())));
      ++n_keys;
    });
  }
  CHECK(n_keys > 0);
}
