#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <limits>
#include <sstream>

#include "io/csv.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

TEST_CASE("a table reads back to the same bits", "[csv]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "diagnostics.csv";
  const std::vector<double> values{
      0.1, 1.0 / 3, 12, -0.0, 1e-300, std::numeric_limits<double>::denorm_min(), 1e300, 5e15, std::nextafter(1.0, 2.0)};
  {
    CsvWriter csv(path, {"time", "mass"});
    for (const double v : values) csv.row(std::vector{v, -v});
    csv.close();
  }
  std::istringstream in(text_of(path));
  std::string line;
  std::getline(in, line);
  CHECK(line == "time,mass");
  for (const double v : values) {
    std::getline(in, line);
    char* rest = nullptr;
    const double first = std::strtod(line.c_str(), &rest);
    REQUIRE(*rest == ',');
    CHECK((first == v && std::signbit(first) == std::signbit(v)));
    CHECK(std::strtod(rest + 1, nullptr) == -v);
  }
  CHECK_FALSE(std::getline(in, line));
}

TEST_CASE("numbers stand in their shortest form, whatever the locale", "[csv]") {
  const TemporaryFolder folder;
  for (const char* locale : {"C", "de_DE.UTF-8"}) {
    std::setlocale(LC_ALL, locale);
    CsvWriter csv(folder.path() / "t.csv", {"a", "b", "c"});
    csv.row(std::vector{0.1, 3.0, 1234567.5});
    csv.close();
    std::setlocale(LC_ALL, "C");
    CHECK(text_of(folder.path() / "t.csv") == "a,b,c\n0.1,3,1234567.5\n");
  }
}

TEST_CASE("rows are buffered until they are flushed, and the header never", "[csv]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  CsvWriter csv(path, {"n"});
  CHECK(text_of(path) == "n\n");
  csv.row(std::vector{1.0});
  CHECK(text_of(path) == "n\n");
  csv.flush();
  CHECK(text_of(path) == "n\n1\n");
  for (int i = 0; i < 40000; ++i) csv.row(std::vector{2.0});
  CHECK(text_of(path).size() > 65536);
}

TEST_CASE("the last column may hold a word", "[csv]") {
  const TemporaryFolder folder;
  CsvWriter csv(folder.path() / "t.csv", {"dt", "limiter"});
  csv.row(std::vector{0.5}, "dense_flow");
  csv.close();
  CHECK(text_of(folder.path() / "t.csv") == "dt,limiter\n0.5,dense_flow\n");
}

TEST_CASE("a table that is left open is written when it goes", "[csv]") {
  const TemporaryFolder folder;
  { CsvWriter(folder.path() / "t.csv", {"n"}).row(std::vector{7.0}); }
  CHECK(text_of(folder.path() / "t.csv") == "n\n7\n");
}

TEST_CASE("a table that cannot be written is Error(io_failed)", "[csv]") {
  const TemporaryFolder folder;
  const auto fails = [](auto&& f) {
    try {
      f();
    } catch (const Error& error) {
      return error.code() == ExitCode::io_failed;
    }
    return false;
  };
  CHECK(fails([&] { CsvWriter(folder.path() / "absent" / "t.csv", {"n"}); }));
  CHECK(fails([&] { CsvWriter("/dev/full", {"n"}); }));

  CsvWriter csv(folder.path() / "t.csv", {"n"});
  csv.row(std::vector{1.0});
  {
    const CallWatch watch(0, ENOSPC);
    CHECK(fails([&] { csv.flush(); }));
  }
  CHECK(fails([&] { csv.flush(); }));
  CHECK_NOTHROW(csv.close());
}
