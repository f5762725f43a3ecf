/// The clocks with which the program measures time.
#pragma once

#include <chrono>
#include <ctime>

namespace rubatlas::mpi {

/// Time [s] of a clock that is never set back.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// CPU time of this process [s]; other processes on the machine do not count.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Adds up the CPU time of this process between its starts and stops. A reading takes most of a microsecond.
class ProcessorWatch {
 public:
  void start() {
    reading_ = processor_seconds();
    is_running_ = true;
  }
  void stop() {
    const double now = processor_seconds();
    seconds_ += now - reading_;
    reading_ = now;
    is_running_ = false;
  }
  [[nodiscard]] bool is_running() const { return is_running_; }
  [[nodiscard]] double seconds() const { return seconds_; }  ///< up to the last stop
  [[nodiscard]] double reading() const { return reading_; }  ///< of the clock at the last start or stop

 private:
  double seconds_ = 0.0;
  double reading_ = processor_seconds();
  bool is_running_ = false;
};

}  // namespace rubatlas::mpi
