#include "bie/runs/checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "bie/files/hdf5_reader.hpp"
#include "bie/files/hdf5_writer.hpp"
#include "bie/files/sealed_file.hpp"
#include "bie/scene/scene.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr std::int64_t schema_of_one = 15, schema_of_several = 16;

std::int64_t schema_of(std::size_t n_vesicles) { return n_vesicles > 1 ? schema_of_several : schema_of_one; }

/// Groups and datasets of states.
constexpr const char* state_of_run = "/state";
constexpr const char* state_of_companion = "/companion";
constexpr const char* state_of_origin = "/origin";
constexpr const char* run_of_origin = "/origin_run";

/// Group of a vesicle in that of its state.
std::string group_of_vesicle(const std::string& state, std::size_t vesicle, std::size_t n_vesicles) {
  return n_vesicles > 1 ? fmt::format("{}/{:02d}", state, vesicle) : state;
}

/// The members of a state that all vesicles share, with the names under which they are stored.
template <typename StateType, typename Visitor>
void visit_time(StateType& state, Visitor&& visit) {
  visit("time", state.time);
  visit("step", state.step);
  visit("dt_next", state.dt_next);
  visit("dt_found", state.dt_found);
  visit("past_times", state.past_times);
}

/// The members of one vesicle, with the names under which they are stored.
template <typename VesicleType, typename Visitor>
void visit_vesicle(VesicleType& vesicle, Visitor&& visit) {
  visit("quadrature_level", vesicle.quadrature_level);
  for_each_field([&](const FieldRow& row, auto& field) { visit(row.name, field); }, vesicle);
  visit("reference_area", vesicle.reference_area);
  visit("reference_volume", vesicle.reference_volume);
  visit("crossing", vesicle.crossing);
  visit("tension", vesicle.recycled.tension);
  visit("flow", vesicle.recycled.flow);
  visit("unaided_iterations", vesicle.recycled.unaided_iterations);
  visit("pause", vesicle.recycled.pause);
  visit("past", vesicle.past);
}

/// Suffixes of the datasets of a recycled subspace: coefficient indices of its rows, arguments, responses.
constexpr const char* entries_of = "_entries";
constexpr const char* arguments_of = "_arguments";
constexpr const char* responses_of = "_responses";

std::string totals_text(const RunTotals& totals) {
  const nlohmann::json json = {{"seconds", totals.seconds},
                               {"kernel_evaluations", totals.kernel_evaluations},
                               {"seconds_of_parts", totals.seconds_of_parts},
                               {"pair_targets", totals.pair_targets}};
  return json.dump();
}

RunTotals totals_of(const std::string& text, const Hdf5Reader& file) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    return {json.at("seconds").get<double>(), json.at("kernel_evaluations").get<std::map<std::string, std::uint64_t>>(),
            json.at("seconds_of_parts").get<std::map<std::string, double>>(),
            json.value("pair_targets", std::map<std::string, std::uint64_t>())};
  } catch (const nlohmann::json::exception& error) {
    file.refuse(fmt::format("/totals is damaged ({})", error.what()));
  }
}

std::vector<SceneChange> read_changes(const Hdf5Reader& file) {
  try {
    return changes_of(nlohmann::json::parse(file.text("/changes")));
  } catch (const nlohmann::json::exception& error) {
    file.refuse(fmt::format("/changes is damaged ({})", error.what()));
  }
}

/// Integer members of a checkpoint besides its states.
template <typename CheckpointType, typename Visitor>
void visit_counts(CheckpointType& checkpoint, std::size_t n_vesicles, Visitor&& visit) {
  if (n_vesicles > 1) {
    visit("vesicles_bytes", checkpoint.vesicles_bytes);
    visit("vesicles_checksum", checkpoint.vesicles_checksum);
  }
  visit("start_order", checkpoint.start_order);
  visit("n_rows", checkpoint.n_rows);
  visit("history_bytes", checkpoint.history_bytes);
  visit("history_checksum", checkpoint.history_checksum);
  visit("n_snapshots", checkpoint.n_snapshots);
  visit("snapshots_checksum", checkpoint.snapshots_checksum);
  visit("threads", checkpoint.threads);
}

/// Members of a companion besides its state.
template <typename CompanionType, typename Visitor>
void visit_companion(CompanionType& companion, Visitor&& visit) {
  visit("start_order", companion.start_order);
  visit("lost", companion.lost);
  visit("bytes", companion.bytes);
  visit("checksum", companion.checksum);
  visit("former", companion.former);
  visit("waiting", companion.waiting);
}

struct WriteVisitor {
  Hdf5Writer& file;
  std::string group;
  void operator()(const char* name, const double& value) { file.attribute(group, name, value); }
  void operator()(const char* name, const std::int64_t& value) { file.attribute(group, name, value); }
  void operator()(const char* name, const std::shared_ptr<const RecycledScalars>& known) {
    if (!known) return;
    const std::vector<Index>& entries = known->entries();
    const auto n = static_cast<Index>(entries.size());
    const Vector numbers = Eigen::Map<const Eigen::Matrix<Index, Eigen::Dynamic, 1>>(entries.data(), n).cast<double>();
    (*this)((std::string(name) + entries_of).c_str(), numbers);
    (*this)((std::string(name) + arguments_of).c_str(), known->subspace().arguments);
    (*this)((std::string(name) + responses_of).c_str(), known->subspace().responses);
  }
  void operator()(const char* name, const std::optional<FirstCrossing>& crossing) {
    if (!crossing) return;
    const Vector numbers{{crossing->time, crossing->place.x(), crossing->place.y(), crossing->place.z()}};
    (*this)(name, numbers);
  }
  template <typename Derived>
  void operator()(const char* name, const Eigen::PlainObjectBase<Derived>& values) {
    if (values.size() == 0) return;
    std::vector<hsize_t> extents{static_cast<hsize_t>(values.rows())};
    if (Derived::ColsAtCompileTime != 1) extents.insert(extents.begin(), static_cast<hsize_t>(values.cols()));
    file.numbers(group + "/" + name, {values.data(), static_cast<std::size_t>(values.size())}, extents,
                 {"1", "member of the state of the run, as the run computes with it"});
  }
};

struct ReadVisitor {
  const Hdf5Reader& file;
  std::string group;
  void operator()(const char* name, double& value) { value = file.number_attribute(group, name); }
  void operator()(const char* name, std::int64_t& value) { value = file.integer_attribute(group, name); }
  void operator()(const char* name, std::shared_ptr<const RecycledScalars>& known) {
    Vector numbers;
    RecycledSubspace stored;
    (*this)((std::string(name) + entries_of).c_str(), numbers);
    (*this)((std::string(name) + arguments_of).c_str(), stored.arguments);
    (*this)((std::string(name) + responses_of).c_str(), stored.responses);
    if (stored.count() == 0) return;
    std::vector<Index> entries;
    for (const double number : numbers) {
      // A run writes coefficient indices: whole numbers in ascending order, below those of the highest degree.
      const bool ascends = entries.empty() || number > static_cast<double>(entries.back());
      if (!(number >= 0.0 && number < n_coefficients(highest_order) && number == std::floor(number) && ascends)) {
        file.refuse(fmt::format("{}/{}{} are not those of a run", group, name, entries_of));
      }
      entries.push_back(static_cast<Index>(number));
    }
    try {
      known = std::make_shared<const RecycledScalars>(std::move(entries), std::move(stored));
    } catch (const ShapeError& error) {
      file.refuse(fmt::format("{}/{}: {}", group, name, error.what()));
    }
  }
  void operator()(const char* name, std::optional<FirstCrossing>& crossing) {
    Vector numbers;
    (*this)(name, numbers);
    if (numbers.size() == 0) return;
    if (numbers.size() != 4) file.refuse(fmt::format("{}/{} is not that of a run", group, name));
    crossing = FirstCrossing{numbers[0], numbers.tail<3>()};
  }
  template <typename Derived>
  void operator()(const char* name, Eigen::PlainObjectBase<Derived>& values) {
    const std::string dataset = group + "/" + name;
    if (!file.has(dataset)) return;
    if constexpr (Derived::ColsAtCompileTime == 1) {
      values.derived() = file.vector(dataset);
    } else {
      values.derived() = file.matrix(dataset);
    }
  }
};

/// Rejects content that no run can have written, although its seal is intact.
class SoundCheck {
 public:
  explicit SoundCheck(const Hdf5Reader& file) : file_(file) {}

  void run(const Checkpoint& checkpoint) const {
    const State& state = checkpoint.state;
    visit_counts(checkpoint, state.vesicles.size(),
                 [&](const char* name, std::int64_t value) { require(value >= 0, name); });
    require(checkpoint.start_order >= lowest_order && checkpoint.start_order <= highest_order, "start_order");
    check(state);
    if (checkpoint.origin) check(checkpoint.origin->state);
    if (!checkpoint.companion) return;
    const CompanionState& companion = *checkpoint.companion;
    check(companion.state);
    visit_companion(companion, [&](const char* name, const auto& value) {
      if constexpr (std::is_same_v<decltype(value), const std::int64_t&>) require(value >= 0, name);
    });
    require(companion.start_order >= lowest_order && companion.start_order <= highest_order, "start_order");
    // `waiting` is empty if no row waits, `former` if nothing has been compared.
    const bool has_both = companion.waiting.size() > 0 && companion.former.size() > 0;
    require(!has_both || companion.waiting.cols() == companion.former.size(), state_of_companion);
  }

 private:
  void require(bool holds, const char* what) const {
    if (!holds) file_.refuse(fmt::format("{} is not that of a run", what));
  }

  void check(const State& state) const {
    for (const VesicleState& vesicle : state.vesicles) check(vesicle);
    require(std::isfinite(state.time) && std::isfinite(state.dt_next) && std::isfinite(state.dt_found), state_of_run);
    require(state.past_times.size() < highest_time_order && state.past_times.allFinite(), "/state/past_times");
    for (const double time : state.past_times) require(time < 0.0, "/state/past_times");
    for (const VesicleState& vesicle : state.vesicles) {
      const Matrix& past = vesicle.past;
      require(past.size() == 0 || (past.rows() == vesicle.position.rows() && state.past_times.size() > 0 &&
                                   past.cols() == state.past_times.size() * columns_of<Unknowns>(vesicle).cols()),
              "/state/past");
      require(past.allFinite(), "/state/past");
    }
  }

  void check(const VesicleState& vesicle) const {
    require(vesicle.position.cols() == 3 && vesicle.position.allFinite(), "/state/position");
    require(vesicle.position.rows() <= n_coefficients(highest_order), "/state/position");
    try {
      order_of(vesicle.position.rows());
    } catch (const ShapeError&) {
      require(false, "/state/position");
    }
    for_each_field(
        [&](const FieldRow& row, const auto& values) {
          require((values.size() == 0 || values.rows() == vesicle.position.rows()) && values.allFinite(), row.name);
        },
        vesicle);
    require(vesicle.material.bending_modulus.size() == vesicle.material.spontaneous_curvature.size(), "/state");
    for (const auto& known : {vesicle.recycled.tension, vesicle.recycled.flow}) {
      if (!known) continue;
      const char* name = "/state, a recycled subspace,";
      const Matrix& arguments = known->subspace().arguments;
      const Matrix& responses = known->subspace().responses;
      require(arguments.rows() <= 2 * n_coefficients(highest_order) && arguments.cols() <= thresholds::most_recycled,
              name);
      require(arguments.allFinite() && responses.allFinite(), name);
    }
    require(std::isfinite(vesicle.reference_area) && std::isfinite(vesicle.reference_volume), "/state");
  }

  const Hdf5Reader& file_;
};

/// Number of vesicles in a checkpoint.
std::size_t n_vesicles_in(const Hdf5Reader& file) {
  const std::int64_t version = file.integer_attribute("/", "schema_version");
  if (version == schema_of_one) return 1;
  if (version != schema_of_several) {
    throw OtherSchemaVersion(fmt::format("{}: has schema version {}; accepted: {}, {}", file.name(), version,
                                         schema_of_one, schema_of_several));
  }
  std::size_t count = 0;
  while (file.has(group_of_vesicle(state_of_run, count, 2))) ++count;
  if (count < 2) file.refuse("lacks vesicles below /state");
  return count;
}

void write_state(Hdf5Writer& file, const std::string& place, const State& state) {
  file.group(place);
  visit_time(state, WriteVisitor{file, place});
  const std::size_t n = state.vesicles.size();
  for (std::size_t a = 0; a < n; ++a) {
    const std::string group = group_of_vesicle(place, a, n);
    if (n > 1) file.group(group);
    visit_vesicle(state.vesicles[a], WriteVisitor{file, group});
  }
}

State read_state(const Hdf5Reader& file, const std::string& place, std::size_t n_vesicles) {
  State state;
  state.vesicles.resize(n_vesicles);
  visit_time(state, ReadVisitor{file, place});
  for (std::size_t a = 0; a < n_vesicles; ++a) {
    visit_vesicle(state.vesicles[a], ReadVisitor{file, group_of_vesicle(place, a, n_vesicles)});
  }
  return state;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const std::size_t n = checkpoint.state.vesicles.size();
  Hdf5Writer file(path, Hdf5Writer::Mode::in_memory);
  file.attribute("/", "schema_version", schema_of(n));
  visit_counts(checkpoint, n, [&](const char* name, std::int64_t value) { file.attribute("/", name, value); });
  file.text("/scene", checkpoint.scene);
  file.text("/changes", json_of(checkpoint.changes).dump());
  file.text("/totals", totals_text(checkpoint.totals));
  write_state(file, state_of_run, checkpoint.state);
  if (checkpoint.origin) {
    write_state(file, state_of_origin, checkpoint.origin->state);
    file.text(run_of_origin, checkpoint.origin->run);
  }
  if (checkpoint.companion) {
    write_state(file, state_of_companion, checkpoint.companion->state);
    visit_companion(*checkpoint.companion, WriteVisitor{file, state_of_companion});
  }
  replace_file(path, sealed(file.image()));
}

Checkpoint checkpoint_of(const std::string& image, const std::string& name) {
  const Hdf5Reader file(image, name);
  const std::size_t n = n_vesicles_in(file);
  Checkpoint checkpoint;
  visit_counts(checkpoint, n,
               [&](const char* count, std::int64_t& value) { value = file.integer_attribute("/", count); });
  checkpoint.scene = file.text("/scene");
  checkpoint.changes = read_changes(file);
  checkpoint.totals = totals_of(file.text("/totals"), file);
  checkpoint.state = read_state(file, state_of_run, n);
  if (file.has(state_of_origin)) {
    checkpoint.origin = Origin{file.text(run_of_origin), read_state(file, state_of_origin, n)};
  }
  if (file.has(state_of_companion)) {
    checkpoint.companion.emplace().state = read_state(file, state_of_companion, n);
    visit_companion(*checkpoint.companion, ReadVisitor{file, state_of_companion});
  }
  SoundCheck(file).run(checkpoint);
  return checkpoint;
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  // HDF5 can crash on damaged bytes: the seal is verified before it reads any.
  return checkpoint_of(read_sealed_file(path), path.string());
}

}  // namespace vehd
