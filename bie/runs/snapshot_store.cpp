#include "bie/runs/snapshot_store.hpp"

#include <fmt/format.h>

#include "bie/files/hdf5_reader.hpp"
#include "bie/files/run_file.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Attribute of a run.h5 whose snapshots were converted to another degree: their checksum before. It identifies them
/// until the checkpoint has their new checksum.
constexpr const char* converted_from = "converted_from";

std::string group_of(std::int64_t number) { return "/snapshots/" + snapshot_name(number); }

void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing, error);
  if (error) throw OutputError(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
}

/// Writes a file and removes it if that fails, so that it does not occupy space on a full disk.
template <typename Write>
void or_remove(const std::filesystem::path& file, Write write) {
  try {
    write();
  } catch (const OutputError&) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    throw;
  }
}

}  // namespace

void require_counted(const RunReader& run, std::int64_t count, std::int64_t expected) {
  const Hdf5Reader& file = run.file();
  if (const auto present = std::ssize(run.times()); present < count) {
    file.refuse(fmt::format("holds {} of the {} snapshots that checkpoint.h5 counts", present, count));
  }
  const bool converted =
      file.has_attribute("/", converted_from) && file.integer_attribute("/", converted_from) == expected;
  if (run.checksum(static_cast<std::size_t>(count)) != expected && !converted) {
    file.refuse("holds other snapshots than those that checkpoint.h5 counts");
  }
}

SnapshotStore::SnapshotStore(std::filesystem::path path, const WriteHeader& write_header, const Kept& kept)
    : path_(end_of_links(path).path),
      spare_(path_.parent_path() / fmt::format(".{}.spare", path_.filename().string())),
      size_(kept.count),
      spare_size_(kept.count),
      checksum_(kept.convert ? Checksum() : Checksum(kept.checksum)) {
  // A kill can leave a damaged spare, or snapshots that the checkpoint does not count yet; both are written again.
  std::error_code ignored;
  std::filesystem::remove(spare_, ignored);
  std::filesystem::remove(link_of(path_), ignored);
  const std::filesystem::path fresh = temporary_of(path_);
  or_remove(fresh, [&] {
    Hdf5Writer file(fresh, Hdf5Writer::Mode::create);
    write_header(file);
    if (kept.convert) file.attribute("/", converted_from, kept.checksum);
    file.seal("/");
    if (kept.convert) {
      for (std::int64_t number = 0; number < kept.count; ++number) {
        checksum_.add(kept.convert(file, static_cast<std::size_t>(number)));
      }
    } else if (kept.count > 0) {
      Hdf5Writer present(path_, Hdf5Writer::Mode::read);
      for (std::int64_t number = 0; number < kept.count; ++number) file.copy_from(present, group_of(number));
    }
    file.close();
    synchronise_file(fresh);
  });
  rename_file(fresh, path_);
  or_remove(spare_, [&] { copy_whole(path_, spare_); });
}

Hdf5Writer SnapshotStore::open_spare() {
  try {
    return {spare_, Hdf5Writer::Mode::extend};
  } catch (const OutputError&) {
    // Whoever opened run.h5 before the last exchange of names still reads this file and has locked it: it is theirs.
    std::error_code ignored;
    std::filesystem::remove(spare_, ignored);
    copy_whole(path_, spare_);
    spare_size_ = size_;
    return {spare_, Hdf5Writer::Mode::extend};
  }
}

void SnapshotStore::add(std::size_t count, const WriteSnapshot& write) {
  std::vector<std::int64_t> checksums;
  or_remove(spare_, [&] {
    Hdf5Writer spare = open_spare();
    if (spare_size_ < size_) {
      Hdf5Writer current(path_, Hdf5Writer::Mode::read);
      for (; spare_size_ < size_; ++spare_size_) spare.copy_from(current, group_of(spare_size_));
    }
    for (std::size_t i = 0; i < count; ++i) {
      checksums.push_back(write(spare, snapshot_name(size_ + static_cast<std::int64_t>(i)), i));
    }
    spare.close();
    synchronise_file(spare_);
  });
  exchange_files(path_, spare_);
  spare_size_ = size_;
  size_ += static_cast<std::int64_t>(count);
  for (const std::int64_t checksum : checksums) checksum_.add(checksum);
}

void SnapshotStore::finish() {
  std::error_code ignored;
  std::filesystem::remove(spare_, ignored);
}

}  // namespace vehd
