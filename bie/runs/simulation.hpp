#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/run_status.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/evaluation/lab_frame_output.hpp"
#include "bie/stepping/evolution.hpp"

namespace vehd {

/// A row of the history with its state and fields, in the frame of the computation.
struct RecordedSide {
  HistoryRow row;
  const State& state;
  const Fields& fields;
};

/// The row in the laboratory frame.
/// @param order  degree of the results of `laboratory`
HistoryRow row_in_laboratory(const LabFrameOutput& laboratory, int order, const RecordedSide& side);

/// A simulation of a scene in memory; the caller decides what is stored. Its steps are bit for bit those of a run of
/// the scene.
class Simulation {
 public:
  /// @param scene  must outlive the simulation
  /// @param from   checkpoint from which a run resumes; that of a new run has no state
  /// @param units  units of results and messages
  /// @param ranks  ranks that simulate together: all calls that compute are collective
  /// @throws InputError if the shape file cannot be used, ConvergenceError
  Simulation(const Scene& scene, Checkpoint from, OutputUnits units, Ranks ranks = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Solves everything at the start, before the first step. @throws ConvergenceError
  void start();
  /// Whether the end time is reached, or rest if the scene runs until rest.
  [[nodiscard]] bool at_end() const { return evolution_.state().time >= scene_.numerics.end_time || at_rest(); }
  /// Takes one accepted step. @throws ConvergenceError if none is acceptable; nothing changes then
  void step() { step(events_); }
  /// Takes one accepted step towards other times than those of the scene.
  /// @throws ConvergenceError as step()
  void step(const EventTimes& events);
  /// See Evolution::scale_largest_step.
  void scale_largest_step(double times) { evolution_.scale_largest_step(times); }

  /// The rows of the history for the start or for the last step; those of snapshots within the step come first.
  [[nodiscard]] std::vector<RecordedSide> sides() const;
  /// Progress after the start or the last step.
  [[nodiscard]] RunStatus status() const;
  /// Work of all sessions: kernels are summed over all ranks, seconds are those of this rank. Collective.
  [[nodiscard]] RunTotals totals() const;
  /// Checkpoint from which a later session resumes; its numerics, end and snapshot times may differ from those of this
  /// one.
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Text of a time of the scene, for messages.
  [[nodiscard]] std::string time_text(double time) const { return time_unit_.text_of(time); }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// The problem that is solved.
  [[nodiscard]] const Problem& problem() const { return problem_; }
  /// State and evaluation, in the frame of the problem.
  [[nodiscard]] const Evolution& evolution() const { return evolution_; }
  /// See Evolution::keep_former.
  void keep_former(KeepFormer keep) { evolution_.keep_former(std::move(keep)); }
  [[nodiscard]] const OutputUnits& units() const { return units_; }

 private:
  /// Seconds of this session.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }
  [[nodiscard]] bool is_resumed() const { return !from_.state.vesicles.empty(); }
  [[nodiscard]] int start_order() const;
  Evolution evolution_of_scene();
  [[nodiscard]] RecordedSide side_of(const State& state, const Evaluation& evaluation, const SmallestGap& gap,
                                     const StepAttempt& step) const;
  [[nodiscard]] std::string gap_text() const;
  [[nodiscard]] bool at_rest() const;

  const Scene& scene_;
  Instruments instruments_;
  Checkpoint from_;
  OutputUnits units_;
  OutputUnit time_unit_;
  Problem problem_;
  Ranks ranks_;
  EventTimes events_;
  Evolution evolution_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  StepAttempt last_;
  double start_time_;
};

}  // namespace vehd
