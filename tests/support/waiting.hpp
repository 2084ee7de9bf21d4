#pragma once

#include <chrono>
#include <functional>
#include <thread>

/// Whether a condition becomes true before `most` has passed: a limit long enough for any machine, and reached only if
/// something is wrong.
inline bool comes_true(const std::function<bool()>& condition, std::chrono::seconds most) {
  const auto deadline = std::chrono::steady_clock::now() + most;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}
