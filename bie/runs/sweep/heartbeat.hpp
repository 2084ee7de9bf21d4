#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

namespace vehd {

/// Renews the time of a claim as long as this process works at it, whatever else it is busy with. Where the claim is
/// gone, another worker has it: this process then gets a SIGTERM, so that its run ends after the step in hand.
///
/// To be made while an `Interruption` is alive: the signal waits until that looks for it.
class Heartbeat {
 public:
  explicit Heartbeat(std::chrono::milliseconds beat);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// The claim from now on; an empty path: none.
  void watch(const std::filesystem::path& claim);
  /// Whether the claim that is watched was found gone.
  [[nodiscard]] bool lost() const;

 private:
  void beat();

  std::chrono::milliseconds interval_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::filesystem::path claim_;
  bool lost_ = false;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace vehd
