#include "bie/app/checkpoint.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "bie/app/file_system.hpp"
#include "bie/app/hdf5_writer.hpp"
#include "bie/scene/hdf5_reader.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr std::int64_t checkpoint_schema_version = 3;

/// The members of a state with the names under which they are stored.
template <typename StateType, typename Visitor>
void visit_state(StateType& state, Visitor&& visit) {
  visit("time", state.time);
  visit("step", state.step);
  visit("dt_next", state.dt_next);
  visit("quadrature_level", state.quadrature_level);
  visit("position", state.position);
  visit("transmembrane_potential", state.transmembrane_potential);
  visit("tension", state.tension);
  visit("area_strain", state.area_strain);
  visit("reference_area", state.reference_area);
  visit("reference_volume", state.reference_volume);
}

/// 64-bit FNV-1a: HDF5 notices a truncated file but not altered numbers.
class Fingerprint {
 public:
  void add(const void* data, std::size_t bytes) {
    for (const unsigned char byte : std::string_view(static_cast<const char*>(data), bytes)) {
      hash_ = (hash_ ^ byte) * 1099511628211ULL;
    }
  }
  [[nodiscard]] std::int64_t value() const { return static_cast<std::int64_t>(hash_); }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

struct FingerprintVisitor {
  Fingerprint& fingerprint;
  void operator()(const char*, const double& value) { fingerprint.add(&value, sizeof value); }
  void operator()(const char*, const std::int64_t& value) { fingerprint.add(&value, sizeof value); }
  template <typename Derived>
  void operator()(const char*, const Eigen::PlainObjectBase<Derived>& values) {
    fingerprint.add(values.data(), static_cast<std::size_t>(values.size()) * sizeof(double));
  }
};

std::string totals_text(const RunTotals& totals) {
  const nlohmann::json json = {{"seconds", totals.seconds},
                               {"kernel_evaluations", totals.kernel_evaluations},
                               {"seconds_of_parts", totals.seconds_of_parts}};
  return json.dump();
}

RunTotals totals_of(const std::string& text, const Hdf5Reader& file) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    return {json.at("seconds").get<double>(), json.at("kernel_evaluations").get<std::map<std::string, std::uint64_t>>(),
            json.at("seconds_of_parts").get<std::map<std::string, double>>()};
  } catch (const nlohmann::json::exception& error) {
    file.refuse(fmt::format("/totals is damaged ({})", error.what()));
  }
}

std::int64_t fingerprint_of(const Checkpoint& checkpoint) {
  Fingerprint fingerprint;
  visit_state(checkpoint.state, FingerprintVisitor{fingerprint});
  for (const std::int64_t value :
       {checkpoint.n_rows, checkpoint.history_bytes, checkpoint.n_snapshots, checkpoint.threads}) {
    fingerprint.add(&value, sizeof value);
  }
  const std::string totals = totals_text(checkpoint.totals);
  fingerprint.add(checkpoint.scene.data(), checkpoint.scene.size());
  fingerprint.add(totals.data(), totals.size());
  return fingerprint.value();
}

struct WriteVisitor {
  Hdf5Writer& file;
  void operator()(const char* name, const double& value) { file.attribute("/state", name, value); }
  void operator()(const char* name, const std::int64_t& value) { file.attribute("/state", name, value); }
  template <typename Derived>
  void operator()(const char* name, const Eigen::PlainObjectBase<Derived>& values) {
    if (values.size() == 0) return;
    std::vector<hsize_t> extents{static_cast<hsize_t>(values.rows())};
    if (Derived::ColsAtCompileTime != 1) extents.insert(extents.begin(), static_cast<hsize_t>(values.cols()));
    file.numbers(std::string("/state/") + name, {values.data(), static_cast<std::size_t>(values.size())}, extents,
                 {"", "member of the state of the run"});
  }
};

struct ReadVisitor {
  const Hdf5Reader& file;
  void operator()(const char* name, double& value) { value = file.number_attribute("/state", name); }
  void operator()(const char* name, std::int64_t& value) { value = file.integer_attribute("/state", name); }
  template <typename Derived>
  void operator()(const char* name, Eigen::PlainObjectBase<Derived>& values) {
    const std::string dataset = std::string("/state/") + name;
    if (!file.has(dataset)) return;
    if constexpr (Derived::ColsAtCompileTime == 1) {
      values.derived() = file.vector(dataset);
    } else {
      values.derived() = file.matrix(dataset);
    }
  }
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const std::filesystem::path fresh = temporary_of(path);
  Hdf5Writer file(fresh, Hdf5Writer::Mode::create_at_once);
  file.attribute("/", "schema_version", checkpoint_schema_version);
  file.attribute("/", "n_rows", checkpoint.n_rows);
  file.attribute("/", "history_bytes", checkpoint.history_bytes);
  file.attribute("/", "n_snapshots", checkpoint.n_snapshots);
  file.attribute("/", "threads", checkpoint.threads);
  file.attribute("/", "fingerprint", fingerprint_of(checkpoint));
  file.text("/scene", checkpoint.scene);
  file.text("/totals", totals_text(checkpoint.totals));
  file.group("/state");
  visit_state(checkpoint.state, WriteVisitor{file});
  file.close();
  rename_file(fresh, path);
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const std::int64_t version = file.integer_attribute("/", "schema_version");
  if (version != checkpoint_schema_version) {
    file.refuse(fmt::format("has schema version {}; accepted: {}", version, checkpoint_schema_version));
  }
  Checkpoint checkpoint;
  checkpoint.n_rows = file.integer_attribute("/", "n_rows");
  checkpoint.history_bytes = file.integer_attribute("/", "history_bytes");
  checkpoint.n_snapshots = file.integer_attribute("/", "n_snapshots");
  checkpoint.threads = file.integer_attribute("/", "threads");
  checkpoint.scene = file.text("/scene");
  checkpoint.totals = totals_of(file.text("/totals"), file);
  visit_state(checkpoint.state, ReadVisitor{file});
  if (fingerprint_of(checkpoint) != file.integer_attribute("/", "fingerprint")) {
    file.refuse("is damaged: its values do not match their checksum");
  }
  return checkpoint;
}

}  // namespace vehd
