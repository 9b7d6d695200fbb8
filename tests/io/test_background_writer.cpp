#include <atomic>
#include <catch2/catch.hpp>
#include <future>
#include <memory>
#include <stdexcept>
#include <vector>

#include "io/background_writer.hpp"

using namespace spindrift;

TEST_CASE("jobs run in order, on a thread of their own", "[background_writer]") {
  std::vector<int> order;
  std::thread::id thread;
  BackgroundWriter writer;
  for (int i = 0; i < 100; ++i)
    writer.submit([&, i] {
      order.push_back(i);
      thread = std::this_thread::get_id();
    });
  writer.finish();
  REQUIRE(order.size() == 100);
  CHECK(std::ranges::is_sorted(order));
  CHECK(thread != std::this_thread::get_id());
  CHECK_NOTHROW(writer.finish());
}

TEST_CASE("a full queue holds the caller back", "[background_writer]") {
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  std::atomic<int> submitted = 0, done = 0;
  std::promise<void> first_runs;
  BackgroundWriter writer(2);
  writer.submit([&] {
    first_runs.set_value();
    opened.wait();
    ++done;
  });
  first_runs.get_future().wait();
  std::thread caller([&] {
    for (int i = 0; i < 5; ++i) {
      writer.submit([&] { ++done; });
      ++submitted;
    }
  });
  while (submitted < 2) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(submitted == 2);
  CHECK(done == 0);
  gate.set_value();
  caller.join();
  writer.finish();
  CHECK(submitted == 5);
  CHECK(done == 6);
}

TEST_CASE("the first exception drops the jobs behind it and surfaces once", "[background_writer]") {
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  bool ran_behind = false;
  BackgroundWriter writer(2);
  writer.submit([&] {
    opened.wait();
    throw std::runtime_error("disk full");
  });
  writer.submit([&] { ran_behind = true; });
  gate.set_value();
  SECTION("at finish") {
    CHECK_THROWS_WITH(writer.finish(), "disk full");
  }
  SECTION("at submit") {
    CHECK_THROWS_WITH(
        [&] {
          for (int i = 0; i < 1000; ++i) {
            writer.submit([] {});
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }(),
        "disk full");
  }
  CHECK_FALSE(ran_behind);
  bool ran_after = false;
  writer.submit([&] { ran_after = true; });
  writer.finish();
  CHECK(ran_after);
}

TEST_CASE("the destructor runs what was submitted and frees the jobs", "[background_writer]") {
  int done = 0;
  const auto payload = std::make_shared<int>(1);
  {
    BackgroundWriter writer;
    for (int i = 0; i < 3; ++i) writer.submit([&done, payload] { done += *payload; });
  }
  CHECK(done == 3);
  CHECK(payload.use_count() == 1);
  CHECK_NOTHROW([] {
    BackgroundWriter writer;
    writer.submit([] { throw std::runtime_error("nobody asks"); });
  }());
}
