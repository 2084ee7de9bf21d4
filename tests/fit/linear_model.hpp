#pragma once

#include "bie/fit/least_squares.hpp"

namespace vehd::testing {

/// A problem with a model that is a function, whose data are its values at `truth`, all with one deviation.
template <typename Model>
LeastSquares problem_of(const Model& model, const Vector& truth, double deviation, double width = 4.0) {
  LeastSquares problem;
  problem.data = model(truth);
  problem.deviations = Vector::Constant(problem.data.size(), deviation);
  problem.lower = truth.array() - 0.5 * width;
  problem.upper = truth.array() + 0.5 * width;
  problem.start = truth.array() + 0.1 * width;
  problem.model = [model](const std::vector<Vector>& points) {
    std::vector<Prediction> predictions;
    for (const Vector& point : points) predictions.push_back({model(point), ""});
    return predictions;
  };
  return problem;
}

}  // namespace vehd::testing
