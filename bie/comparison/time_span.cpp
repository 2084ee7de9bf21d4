#include "bie/comparison/time_span.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "bie/comparison/check_fields.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/geometry/surface.hpp"
#include "bie/runs/given_times.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/reader.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/solve/flow_equations.hpp"
#include "bie/stepping/solve/rigid_sphere.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

const VesicleModel& vesicle_of_span(const FrozenState& end) { return end.model.vesicles.front(); }

/// End points of the intervals on which the field is smooth.
std::vector<double> smooth_pieces(const Waveform& waveform, double begin, double end, const std::string& file) {
  // Rounding of a discontinuity at which the run has a snapshot.
  constexpr double same_time = 1e-9;
  constexpr std::size_t most_pieces = 32;
  std::vector<double> ends{begin};
  const double last = end - same_time * (end - begin);
  for (std::optional<double> next = waveform.next_discontinuity(begin); next && *next < last;
       next = waveform.next_discontinuity(*next)) {
    ends.push_back(*next);
    if (ends.size() <= most_pieces) continue;
    throw InputError(
        fmt::format("{}: the field jumps more than {} times between --from and --time; accepted: times "
                    "that are closer to each other",
                    file, most_pieces - 1));
  }
  ends.push_back(end);
  return ends;
}

/// Fewest steps for this number of periods, a power of two. Steps near a whole period would find a constant field.
std::int64_t fewest_steps(double periods, const std::string& file) {
  constexpr double steps_a_period = 4.0, fewest = 4.0;
  // The error of the steps is the change by twice as many.
  constexpr double most_periods = most_span_steps / 2 / steps_a_period;
  if (!(periods <= most_periods)) {
    throw InputError(
        fmt::format("{}: the field has {:.4g} periods between --from and --time; accepted: at most {:g}, with times "
                    "that are closer to each other",
                    file, periods, most_periods));
  }
  const double steps = std::max(fewest, std::ceil(steps_a_period * periods));
  return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(steps)));
}

/// @param waveform  of the scene, absent if the field is constant
void take_field(const FrozenState& end, const std::optional<WaveformScene>& waveform, const std::string& file,
                TimeSpan& span) {
  const ElectricParameters electric = electric_parameters(end.model, vesicle_of_span(end));
  const std::vector<double> ends = smooth_pieces(electric.waveform, span.begin, span.end, file);
  span.intervals = span_intervals;
  const auto n_pieces = static_cast<Index>(ends.size()) - 1;
  span.field.resize(n_pieces * (span_intervals + 1), 3);
  double periods = 0.0;
  for (Index piece = 0; piece < n_pieces; ++piece) {
    const double first = ends[static_cast<std::size_t>(piece)], last = ends[static_cast<std::size_t>(piece) + 1];
    if (waveform && alternates(*waveform) && !electric.waveform.is_quiet(first)) {
      periods = std::max(periods, waveform->frequency * (last - first));
    }
    for (std::int64_t i = 0; i <= span_intervals; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(span_intervals);
      const double time = i == span_intervals ? last : first + share * (last - first);
      const Limit limit = i == span_intervals ? Limit::before : Limit::after;
      span.field.row(static_cast<Index>(span.field_times.size())) = electric.at(time, limit).field.transpose();
      span.field_times.push_back(time);
    }
  }
  span.fewest_steps = fewest_steps(periods, file);
}

double radius_of(const Matrix& position) {
  // √(Σ|x_nm|²/4π) over the degrees from 1 on: root mean square distance from the mean position.
  return std::sqrt(position.bottomRows(position.rows() - 1).squaredNorm() / (4.0 * std::numbers::pi));
}

/// Bound of the lengths of the vectors of a series: Σ √((2n+1)/4π) |x_n| over the degrees n.
double largest_length(const Matrix& vectors) {
  double bound = 0.0;
  for (int n = 0; n <= order_of(vectors.rows()); ++n) {
    const Index first = Index{n} * n, size = 2 * Index{n} + 1;
    bound += std::sqrt(static_cast<double>(size) / (4.0 * std::numbers::pi)) * vectors.middleRows(first, size).norm();
  }
  return bound;
}

/// Velocity of the material. A sphere moves as a rigid one, whatever its instantaneous velocity.
/// @param velocity  of the snapshot
Matrix material_velocity(const FrozenState& end, const Matrix& position, const Matrix& velocity) {
  Instruments instruments;
  const Membrane membrane =
      membrane_at(MembraneSpace(settings_at(end, order_of(position.rows())), {}), position, {}, 1.0, instruments);
  const bool is_sphere = uniform_tension_is_free(flow_parameters(end.model, vesicle_of_span(end)), membrane);
  return is_sphere ? rigid_sphere_velocity(membrane, velocity) : velocity;
}

void take_shapes(const RunReader& run, std::size_t first, std::size_t last, const FrozenState& state, TimeSpan& span) {
  int order = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const RunSnapshot snapshot = run.snapshot(i);
    span.shape_times.push_back(snapshot.time());
    span.positions.push_back(resize_order(snapshot.coefficients("x", 3), snapshot.degree()));
    if (state.model.mobile) {
      const Matrix velocity = resize_order(snapshot.coefficients("velocity", 3), snapshot.degree());
      span.velocities.push_back(material_velocity(state, span.positions.back(), velocity));
    }
    order = std::max(order, order_of(span.positions.back().rows()));
  }
  for (std::vector<Matrix>* fields : {&span.positions, &span.velocities}) {
    for (Matrix& field : *fields) field = resize_order(field, order);
  }
  const Matrix end = span.positions.back();
  const double bound = still_motion * radius_of(end), duration = span.end - span.begin;
  // The material of a sphere that rotates moves although its points stand still.
  if (std::ranges::any_of(span.positions, [&](const Matrix& x) { return largest_length(x - end) > bound; }) ||
      std::ranges::any_of(span.velocities, [&](const Matrix& v) { return largest_length(duration * v) > bound; }))
    return;
  span.shape_times = {span.end};
  span.positions = {end};
  span.velocities.clear();
}

}  // namespace

TimeSpan read_time_span(const std::filesystem::path& file, const std::string& from, FrozenState& end) {
  const auto refuse_if = [&](bool problem, const std::string& what) {
    if (problem) throw InputError(fmt::format("{}: {}", file.string(), what));
  };
  refuse_if(file.extension() == ".toml", "--from goes with a run; run the scene and give its run.h5");
  refuse_if(!end.model.electric, "without [electric] there is no V_m; --from accepts runs in a field");
  const std::size_t n_vesicles = end.model.vesicles.size();
  refuse_if(n_vesicles > 1, fmt::format("has {} vesicles; --from accepts a run of one", n_vesicles));
  const VesicleModel& vesicle = vesicle_of_span(end);
  refuse_if(vesicle.reaction || vesicle.has_varying_properties || vesicle.pump,
            "has a membrane that porates or varies in space; --from accepts runs with one that charges "
            "alike everywhere");
  refuse_if(relaxes_charge(end.model),
            "has displacement currents; --from accepts runs without \"displacement_current\"");
  ReadingNotes notes;
  const RunReader run = read_snapshots(file, notes);
  const GivenTimes times(run, file);
  const SnapshotChoice choice = choose_snapshot(run, file, times.number_of(from), times.shown());
  if (!choice.note.empty()) end.notes.push_back(choice.note);
  TimeSpan span;
  span.begin = run.times()[choice.snapshot];
  span.begin_text = shown_time(span.begin, times.shown());
  span.end = end.state.time;
  refuse_if(!(span.begin < span.end), fmt::format("--from {} is not before the snapshot that is checked, at {}; "
                                                  "accepted: the time of an earlier snapshot",
                                                  from, end.time_text));
  const RunSnapshot start = run.snapshot(choice.snapshot);
  span.potential = resize_order(start.coefficients("Vm", 1), start.degree());
  const Scene scene = parse_scene(run.scene(), file.string() + " (scene)", file.parent_path());
  span.control = step_control_of(scene);
  take_shapes(run, choice.snapshot, run.nearest(span.end), end, span);
  take_field(end, scene.electric->waveform, file.string(), span);
  return span;
}

namespace {

/// The membrane at the end of a span.
/// @param start   initial x; the initial V_m is that of the span
/// @param finer   see potential_in_time()
VesicleState advanced(const FrozenState& end, const TimeSpan& span, const Matrix& start, Model model, int order,
                      bool finer) {
  EvolutionSetup setup{std::move(model), settings_at(end, order), end.symmetry, span.control};
  constexpr double smaller_step = 0.25, smaller_tolerance = 0.1;
  if (finer && setup.control.tolerance > 0.0) {
    setup.control.tolerance *= smaller_tolerance;
  } else if (finer) {
    setup.control = fixed_steps(smaller_step * setup.control.largest);
  }
  Instruments instruments;
  State state = initial_state(setup.model, Discretisation(setup.settings, setup.symmetry),
                              {{resize_order(start, order), {.steady = false, .given = span.potential}}},
                              setup.control.tolerance > 0.0 ? 0.0 : setup.control.largest, instruments);
  state.time = span.begin;
  Evolution evolution(std::move(setup), std::move(state), instruments);
  evolution.evaluate_start();
  const EventTimes events{{}, span.end};
  while (evolution.state().time < span.end) evolution.step(events);
  return resized(evolution.state().vesicles.front(), order);
}

}  // namespace

Vector potential_in_time(const FrozenState& end, const TimeSpan& span, int order, bool finer) {
  Model held = end.model;
  held.mobile = false;
  return advanced(end, span, end.state.vesicles.front().position, std::move(held), order, finer)
      .transmembrane_potential;
}

Vector change_by_finer_motion(const FrozenState& end, const TimeSpan& span) {
  if (span.positions.size() == 1) return {};
  // With a tolerance the degree follows the state, up to this one.
  const int order = end.settings.order;
  const VesicleState as_run = advanced(end, span, span.positions.front(), end.model, order, false),
                     finer = advanced(end, span, span.positions.front(), end.model, order, true);
  Instruments instruments;
  const Membrane membrane =
      membrane_at(MembraneSpace(settings_at(end, order), {}), finer.position, {}, 1.0, instruments);
  const Matrix slope =
      surface_gradient(membrane.surface, membrane.fine.synthesize_gradient(finer.transmembrane_potential));
  const Matrix way = membrane.fine.synthesize(as_run.position - finer.position);
  const Vector moved = membrane.fine.analyze(way.cwiseProduct(slope).rowwise().sum());
  const Matrix change = finer.transmembrane_potential + moved - as_run.transmembrane_potential;
  return resize_order(change, order_of(end.state.vesicles.front().position.rows()));
}

}  // namespace vehd
