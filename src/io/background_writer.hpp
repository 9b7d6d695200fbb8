#pragma once
/// Writing beside the simulation, on one thread and in order.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace spindrift {

/// Runs jobs one after another. When a job throws, the jobs behind it are dropped, so that what stands on disk is
/// always a beginning of what was submitted; the exception surfaces at the next submit() or finish() and is then
/// forgotten.
class BackgroundWriter {
 public:
  /// max_waiting: jobs that may wait behind the running one, at least one.
  explicit BackgroundWriter(std::size_t max_waiting = 2);
  /// Runs what was submitted; an exception that nobody asked for is lost: call finish() first.
  ~BackgroundWriter();
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  /// Blocks while the queue is full. Throws what an earlier job threw; `job` is then not queued.
  void submit(std::function<void()> job);

  /// Waits until all jobs are done. Throws what one of them threw.
  void finish();

 private:
  void work();
  void rethrow_failure();

  const std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool running_ = false, stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace spindrift
