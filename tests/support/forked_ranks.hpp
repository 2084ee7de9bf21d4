#pragma once

#include <omp.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bie/support/ranks/parcel.hpp"
#include "bie/support/ranks/ranks.hpp"

/// Ranks without MPI: forked copies of the test that communicate through shared memory.
namespace vehd::testing {

/// Memory shared by all copies.
class SharedMemory {
 public:
  explicit SharedMemory(int n_ranks)
      : n_ranks_(n_ranks), memory_(mapped(kSlot * (static_cast<std::size_t>(n_ranks) + 1))) {
    pthread_barrierattr_t shared;
    pthread_barrierattr_init(&shared);
    pthread_barrierattr_setpshared(&shared, PTHREAD_PROCESS_SHARED);
    pthread_barrier_init(reinterpret_cast<pthread_barrier_t*>(memory_), &shared, static_cast<unsigned>(n_ranks));
  }

  [[nodiscard]] int n_ranks() const { return n_ranks_; }
  void meet() const { pthread_barrier_wait(reinterpret_cast<pthread_barrier_t*>(memory_)); }
  void write(int rank, const std::string& text) const {
    if (text.size() + sizeof(std::size_t) > kSlot) throw std::runtime_error("more than ranks of a test can say");
    const std::size_t size = text.size();
    std::memcpy(slot(rank), &size, sizeof size);
    std::memcpy(slot(rank) + sizeof size, text.data(), size);
  }
  [[nodiscard]] std::string read(int rank) const {
    std::size_t size = 0;
    std::memcpy(&size, slot(rank), sizeof size);
    return {slot(rank) + sizeof size, size};
  }

 private:
  // Pages that are never touched take no memory.
  static constexpr std::size_t kSlot = std::size_t{1} << 26;
  static char* mapped(std::size_t size) {
    void* memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
    return static_cast<char*>(memory);
  }
  [[nodiscard]] char* slot(int rank) const { return memory_ + kSlot * (static_cast<std::size_t>(rank) + 1); }

  int n_ranks_;
  char* memory_;
};

class ForkedLink : public RankLink {
 public:
  ForkedLink(const SharedMemory& memory, int rank) : memory_(memory), rank_(rank) {}
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return memory_.n_ranks(); }
  std::vector<std::string> gather(const std::string& own) override {
    memory_.write(rank_, own);
    memory_.meet();
    std::vector<std::string> all;
    for (int rank = 0; rank < size(); ++rank) all.push_back(memory_.read(rank));
    memory_.meet();
    return all;
  }
  std::vector<std::string> exchange(const std::vector<std::string>& to) override {
    std::vector<std::string> received;
    for (const std::string& sent : gather(packed(to))) {
      received.push_back(unpacked<std::vector<std::string>>(sent)[static_cast<std::size_t>(rank_)]);
    }
    return received;
  }

 private:
  SharedMemory memory_;
  int rank_;
};

/// Result of this work on each of n ranks, or the text of its exception. The first rank is this process.
inline std::vector<std::string> on_ranks(int n, const std::function<std::string(const Ranks&)>& work) {
  if (n == 1) return {work(Ranks())};
  const SharedMemory memory(n);
  const auto said = [&](int rank) -> std::string {
    try {
      return work(Ranks(std::make_shared<ForkedLink>(memory, rank)));
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  std::vector<pid_t> others;
  for (int rank = 1; rank < n; ++rank) {
    others.push_back(::fork());
    if (others.back() != 0) continue;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    // A forked copy does not have the threads of this process.
    omp_set_num_threads(1);
    ForkedLink(memory, rank).gather(said(rank));
    ::_exit(0);
  }
  std::vector<std::string> all = ForkedLink(memory, 0).gather(said(0));
  for (const pid_t other : others) ::waitpid(other, nullptr, 0);
  return all;
}

}  // namespace vehd::testing
