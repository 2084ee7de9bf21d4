#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/bench/result.hpp"

namespace vehd {

/// Which benches are run, and which pages they renew.
struct AllTask {
  std::filesystem::path docs;  ///< folder with the pages, images/ and scenes/
  BenchOutput output;
  bool quick = false;               ///< few degrees and tolerances, one repeat: shows that it works, measures little
  std::vector<std::string> only{};  ///< names of benches; empty: all
};

/// In the order in which they are run.
std::vector<std::string> names_of_benches();

/// Runs every scene, every bench and the commands by which pages make pictures of their own, and renews the pictures
/// and the tables of the pages from their results. Benches of the finite elements are left out where these are not
/// built, and said.
/// @return name and machine of every bench
/// @throws InputError if there are no pages
nlohmann::ordered_json bench_all(const AllTask& task, BenchObserver& observer);

}  // namespace vehd
