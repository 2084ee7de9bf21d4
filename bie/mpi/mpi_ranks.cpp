#include "bie/mpi/mpi_ranks.hpp"

// Only the C interface.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>

#include "bie/support/interruption.hpp"

namespace vehd {

namespace {

constexpr std::array kSetByLaunchers = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};

/// Initialises MPI on construction and finalises it on destruction. Its errors end all ranks, the default of MPI.
class MpiLink : public RankLink {
 public:
  MpiLink() {
    // Threads of MPI inherit the blocked signals; a signal that a run polls for would otherwise end the process there.
    const Interruption inherited;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiLink() override { MPI_Finalize(); }
  MpiLink(const MpiLink&) = delete;
  MpiLink& operator=(const MpiLink&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  std::vector<std::string> gather(const std::string& own) override {
    const std::vector<int> sizes = sizes_of_all(own.size());
    const std::vector<int> places = places_of(sizes);
    std::string all(static_cast<std::size_t>(places.back()), '\0');
    MPI_Request request{};
    MPI_Iallgatherv(own.data(), sizes[static_cast<std::size_t>(rank_)], MPI_CHAR, all.data(), sizes.data(),
                    places.data(), MPI_CHAR, MPI_COMM_WORLD, &request);
    wait(request);
    return parts_of(all, places);
  }

  std::vector<std::string> exchange(const std::vector<std::string>& to) override {
    std::vector<int> sent;
    std::string all_sent;
    for (const std::string& text : to) {
      sent.push_back(size_of(text.size()));
      all_sent += text;
    }
    std::vector<int> received(to.size());
    MPI_Request request{};
    MPI_Ialltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
    wait(request);
    const std::vector<int> from = places_of(sent), at = places_of(received);
    std::string all(static_cast<std::size_t>(at.back()), '\0');
    MPI_Ialltoallv(all_sent.data(), sent.data(), from.data(), MPI_CHAR, all.data(), received.data(), at.data(),
                   MPI_CHAR, MPI_COMM_WORLD, &request);
    wait(request);
    return parts_of(all, at);
  }

 private:
  /// MPI counts with int.
  static int size_of(std::size_t size) {
    if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw std::runtime_error("ranks cannot send more than 2 GB at once: start more of them");
    }
    return static_cast<int>(size);
  }

  /// Offset of each text in their concatenation, and the end of the last one.
  static std::vector<int> places_of(const std::vector<int>& sizes) {
    std::vector<int> places{0};
    std::size_t end = 0;
    for (const int size : sizes) places.push_back(size_of(end += static_cast<std::size_t>(size)));
    return places;
  }

  static std::vector<std::string> parts_of(const std::string& all, const std::vector<int>& places) {
    std::vector<std::string> parts;
    for (std::size_t r = 0; r + 1 < places.size(); ++r) {
      parts.push_back(
          all.substr(static_cast<std::size_t>(places[r]), static_cast<std::size_t>(places[r + 1] - places[r])));
    }
    return parts;
  }

  [[nodiscard]] std::vector<int> sizes_of_all(std::size_t own) const {
    const int size = size_of(own);
    std::vector<int> sizes(static_cast<std::size_t>(size_));
    MPI_Request request{};
    MPI_Iallgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
    wait(request);
    return sizes;
  }

  /// A long wait yields the processor: ranks of Open MPI spin, which costs other ranks, or their own threads, whole
  /// time slices as soon as anything else runs on the machine.
  static void wait(MPI_Request& request) {
    constexpr int kSpins = 200;
    constexpr std::chrono::microseconds kPause{20};
    for (int polls = 0;; ++polls) {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done != 0) return;
      if (polls >= kSpins) std::this_thread::sleep_for(kPause);
    }
  }

  int rank_ = 0, size_ = 1;
};

bool is_started_by_launcher() {
  return std::ranges::any_of(kSetByLaunchers, [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

Ranks mpi_ranks() { return is_started_by_launcher() ? Ranks(std::make_shared<MpiLink>()) : Ranks(); }

int separate_tasks() {
  const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  return tasks == nullptr || is_started_by_launcher() ? 1 : std::atoi(tasks);
}

}  // namespace vehd
