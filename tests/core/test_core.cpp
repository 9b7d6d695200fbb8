#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/stages.hpp"
#include "core/vec.hpp"

using namespace spindrift;

TEMPLATE_TEST_CASE_SIG("Indices run first axis fastest and come back", "[core]", ((int Dim), Dim), 2, 3) {
  Index<Dim> shape{3, 4};
  if constexpr (Dim == 3) shape[2] = 2;
  std::size_t n = 0;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    CHECK(flat<Dim>(i, shape) == n);
    CHECK(unflat<Dim>(n, shape) == i);
    CHECK(inside<Dim>(i, shape));
    ++n;
  });
  CHECK(n == count<Dim>(shape));
}

TEST_CASE("The 2D cross product is the 3D one in the x-z plane", "[core]") {
  const Vec<2> w(1.3, -0.7);
  const Curl<2> omega(2.1);
  const Vec<3> full = cross<3>({1.3, 0, -0.7}, {0, 2.1, 0});
  CHECK(cross<2>(w, omega)[0] == Approx(full[0]));
  CHECK(cross<2>(w, omega)[1] == Approx(full[2]));
}

TEST_CASE("Sums are the same bits with any number of threads", "[core]") {
  const std::size_t n = 100003;
  const auto term = [](std::size_t i) { return 1 / (1.0 + static_cast<double>(i % 977)) - 0.01; };
  std::vector<double> sums;
  for (int threads : {1, 2, 4}) {
    ThreadLimit limit(threads);
    sums.push_back(parallel_sum(n, 0.0, term));
  }
  CHECK(sums[0] == sums[1]);
  CHECK(sums[0] == sums[2]);
  double plain = 0;
  for (std::size_t i = 0; i < n; ++i) plain += term(i);
  CHECK(sums[0] == Approx(plain));
  CHECK(parallel_sum(0, 1.5, term) == 1.5);
}

TEST_CASE("A thread limit holds while it lives", "[core]") {
  const int all = n_threads();
  for (const int limit : {1, 2, 4}) {
    const ThreadLimit threads(limit);
    CHECK(n_threads() == limit);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    // On a busy machine a second thread may come late.
    for (int round = 0; round < 50 && seen.size() < 2; ++round)
      parallel_for(
          64,
          [&](std::size_t) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const std::lock_guard lock(mutex);
            seen.insert(std::this_thread::get_id());
          },
          1);
    CHECK(seen.size() <= static_cast<std::size_t>(limit));
    if (limit > 1) CHECK(seen.size() > 1);
  }
  CHECK(n_threads() == all);
}

TEST_CASE("Every item is visited once", "[core]") {
  for (std::size_t n : {0, 1, 511, 512, 513, 5000}) {
    std::vector<int> visits(n, 0);
    parallel_for(n, [&](std::size_t i) { ++visits[i]; });
    CHECK(std::accumulate(visits.begin(), visits.end(), std::size_t{0}) == n);
  }
}

TEST_CASE("A maximum does not hide a NaN", "[core]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](std::size_t i) { return i == 4500 ? nan : static_cast<double>(i); };
  CHECK(std::isnan(parallel_max(10000, 0, value)));
  CHECK(parallel_max(4000, 0, value) == 3999);
}

TEST_CASE("Random numbers are a function of their key, uniform and independent", "[core]") {
  CHECK(uniform(7, RandomStream::cover_sampling, 3) == uniform(7, RandomStream::cover_sampling, 3));
  CHECK(uniform(7, RandomStream::cover_sampling, 3) != uniform(8, RandomStream::cover_sampling, 3));
  CHECK(uniform(7, RandomStream::cover_sampling, 3) != uniform(7, RandomStream::release_sampling, 3));
  CHECK(uniform(7, RandomStream::cover_sampling, 3, 1) != uniform(7, RandomStream::cover_sampling, 3, 2));
  const int n = 20000;
  double mean = 0, square = 0, lag = 0, exponential_mean = 0;
  for (int i = 0; i < n; ++i) {
    const double u = uniform(1, RandomStream::bernoulli, static_cast<std::uint64_t>(i));
    const double v = uniform(1, RandomStream::bernoulli, static_cast<std::uint64_t>(i) + 1);
    REQUIRE((u > 0 && u < 1));
    mean += u / n, square += u * u / n, lag += (u - 0.5) * (v - 0.5) / n;
    exponential_mean += exponential(1, RandomStream::entrainment_clock, static_cast<std::uint64_t>(i)) / n;
  }
  CHECK(mean == Approx(0.5).margin(5 / std::sqrt(12.0 * n)));
  CHECK(square == Approx(1 / 3.0).margin(5 * 0.3 / std::sqrt(n)));
  CHECK(lag == Approx(0).margin(5 / 12.0 / std::sqrt(n)));
  CHECK(exponential_mean == Approx(1).margin(5 / std::sqrt(n)));
}

TEST_CASE("Stages count passes by name and below", "[core]") {
  Stages stages;
  for (int i = 0; i < 3; ++i) auto timed = stages.time("dense_flow.viscosity");
  { auto timed = stages.time("dense_flow_other"); }
  CHECK(stages.passes("dense_flow") == 3);
  CHECK(stages.passes("suspension") == 0);
  CHECK(stages.all().size() == 2);
}

TEST_CASE("Stages keep their passes when asked to, and no more than asked for", "[core]") {
  Stages stages;
  { const auto timed = stages.time("before"); }
  stages.keep_passes(3);
  for (int i = 0; i < 4; ++i) {
    const auto outer = stages.time("step");
    const auto inner = stages.time("step.part");
  }
  REQUIRE(stages.kept().size() == 3);
  CHECK(stages.all()[stages.kept()[0].stage].name == "step.part");
  CHECK(stages.all()[stages.kept()[1].stage].name == "step");
  CHECK(stages.kept()[1].start <= stages.kept()[0].start);
  CHECK(stages.kept()[1].duration >= stages.kept()[0].duration);
  CHECK(stages.passes("step") == 8);
}
