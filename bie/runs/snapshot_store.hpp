#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/support/checksum.hpp"

namespace vehd {

/// Compares the seals of the first snapshots of a run.h5 with the checksum in a checkpoint.
/// @param checksum  checksum of their checksums, in the order of time; that of the file may differ if a killed session
///                  had already written the same snapshots at another degree
/// @throws InputError if the file lacks some of these snapshots or has others in their place
void require_counted(const RunReader& run, std::int64_t count, std::int64_t checksum);

/// A growing run.h5 that is a complete, closed HDF5 file at every instant.
///
/// A hidden second file lacks the snapshots added last. New ones are written there together with the missing ones, and
/// then the two names are exchanged: a kill leaves either the old or the new file under the name run.h5, and a reader
/// keeps the file that it has opened. The cost of a snapshot does not grow with the run, unless another program has
/// run.h5 open; snapshots added together share the opening and closing of files.
class SnapshotStore {
 public:
  using WriteHeader = std::function<void(Hdf5Writer&)>;
  /// Writes snapshot i of those that are added together. Returns the checksum of its seal.
  using WriteSnapshot = std::function<std::int64_t(Hdf5Writer&, const std::string& name, std::size_t i)>;
  /// Writes a kept snapshot of the existing file at another degree. Returns the checksum of its seal.
  using ConvertSnapshot = std::function<std::int64_t(Hdf5Writer&, std::size_t number)>;

  /// Snapshots of an existing file that are kept.
  struct Kept {
    std::int64_t count = 0;
    std::int64_t checksum = 0;  ///< checksum of their checksums, verified by the caller
    ConvertSnapshot convert;    ///< if empty, they are copied unchanged
  };

  /// Starts a file, empty or with the first snapshots of an existing one. @throws OutputError
  SnapshotStore(std::filesystem::path path, const WriteHeader& write_header, const Kept& kept);

  /// Adds `count` snapshots, each written by write(file, name, i) for i = 0 … count − 1. @throws OutputError
  void add(std::size_t count, const WriteSnapshot& write);

  /// Number of snapshots in the file.
  [[nodiscard]] std::int64_t size() const { return size_; }
  /// Checksum of their checksums, in the order of time.
  [[nodiscard]] std::int64_t checksum() const { return checksum_.value(); }

  /// Removes the hidden second file: the run is complete.
  void finish();

 private:
  Hdf5Writer open_spare();

  std::filesystem::path path_, spare_;
  std::int64_t size_ = 0;
  std::int64_t spare_size_ = 0;
  Checksum checksum_;
};

}  // namespace vehd
