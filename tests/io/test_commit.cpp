#include <catch2/catch.hpp>

#include "io/commit.hpp"
#include "io/system_calls.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> durable_order{"open",   "write",       "fsync",       "close",
                                             "rename", "open folder", "fsync folder"};

/// What f throws.
template <class F>
Error error_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  }
  return {ExitCode::done, "nothing was thrown"};
}

}  // namespace

TEST_CASE("commit writes, syncs, renames and syncs the folder, in this order", "[commit]") {
  const TemporaryFolder folder;
  const CallWatch watch;
  commit(folder.path() / "frame.hdf", std::string_view("snow"));
  CHECK(watch.calls() == durable_order);
  CHECK(text_of(folder.path() / "frame.hdf") == "snow");
  CHECK(folder.n_entries() == 1);
}

TEST_CASE("commit replaces a file, also by an empty one", "[commit]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "frame.hdf";
  commit(path, std::string_view("old and long"));
  commit(path, std::string_view("new"));
  CHECK(text_of(path) == "new");
  commit(path, std::string_view());
  CHECK(text_of(path).empty());
  CHECK(folder.n_entries() == 1);
}

TEST_CASE("every failing call is an Error(io_failed), keeps the old file and leaves no temporary", "[commit]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "frame.hdf";
  commit(path, std::string_view("old"));
  for (std::size_t n = 0; n < durable_order.size(); ++n) {
    CAPTURE(n, durable_order[n]);
    const Error error = error_of([&] {
      const CallWatch watch(n, ENOSPC);
      commit(path, std::string_view("new one"));
    });
    CHECK(error.code() == ExitCode::io_failed);
    CHECK_THAT(error.what(), Contains(path.string()) && Contains(durable_order[n] + ": No space left") &&
                                 Contains("needed 7 bytes") && Contains("free "));
    const bool renamed = n > 4;
    CHECK(text_of(path) == (renamed ? "new one" : "old"));
    CHECK(folder.n_entries() == 1);
    commit(path, std::string_view("old"));
  }
}

TEST_CASE("interrupted calls and short writes are continued", "[commit]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "frame.hdf";
  constexpr std::size_t n_calls = 10;  // as above, with four writes for ten bytes of which three go at a time
  for (std::size_t n = 0; n < n_calls; ++n) {
    const CallWatch watch(n, EINTR, 3);
    commit(path, std::string_view("0123456789"));
    CHECK(text_of(path) == "0123456789");
    const bool tried_again = watch.calls().at(n) != "close";
    CHECK(watch.calls().size() == n_calls + (tried_again ? 1 : 0));
  }
}

TEST_CASE("places that cannot be written are told", "[commit]") {
  const TemporaryFolder folder;
  commit(folder.path() / "file", std::string_view("x"));
  std::filesystem::create_directory(folder.path() / "folder");
  const auto path = GENERATE_REF(folder.path() / "file" / "under.hdf", folder.path() / "absent" / "frame.hdf",
                                 folder.path() / "folder");
  const Error error = error_of([&] { commit(path, std::string_view("x")); });
  CHECK(error.code() == ExitCode::io_failed);
  CHECK_THAT(error.what(), Contains(path.string()));
  CHECK(folder.n_entries() == 2);
}

TEST_CASE("stale temporaries are swept, everything else stays", "[commit]") {
  const TemporaryFolder folder;
  for (const char* name : {".a.hdf.tmp", ".b.tmp", "c.tmp", ".hidden", "d.hdf"})
    std::ofstream(folder.path() / name) << "x";
  std::filesystem::create_directory(folder.path() / ".folder.tmp");
  CHECK(remove_stale_temporaries(folder.path()) == 2);
  CHECK(folder.n_entries() == 4);
  CHECK(remove_stale_temporaries(folder.path()) == 0);
  CHECK(remove_stale_temporaries(folder.path() / "absent") == 0);
  CHECK(error_of([&] { remove_stale_temporaries(folder.path() / "d.hdf"); }).code() == ExitCode::io_failed);
}
