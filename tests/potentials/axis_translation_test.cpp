#include "bie/potentials/axis_translation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "bie/support/types.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(axis_translation)

namespace {

constexpr int kHighest = 24;

Matrix random_points(Index n, unsigned seed) {
  std::mt19937 bits(seed);
  Matrix points(n, 3);
  for (double& x : points.reshaped()) x = static_cast<double>(bits()) / 0x1p31 - 1.0;
  return points / std::sqrt(3.0);  // within the unit ball
}

/// Forces at points about a centre, with their moments.
struct Cloud {
  Vector3 centre;
  Matrix points, forces;
  RowMatrix moments;

  Cloud(const AxisTranslation& translation, const Vector3& at, unsigned seed)
      : centre(at), points(random_points(5, seed)), forces(random_points(5, seed + 1000)) {
    Matrix charges(forces.rows(), 4);
    charges << forces, points.cwiseProduct(forces).rowwise().sum();
    moments = translation.turnable(vehd::moments(regular_harmonics(points, kHighest).transpose() * charges));
  }

  /// Sums Σ f/|x − y| over the forces and over (y − origin)·f.
  [[nodiscard]] Eigen::RowVector4d at(const Vector3& x) const {
    Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
    for (Index i = 0; i < points.rows(); ++i) {
      const Vector3 y = centre + points.row(i).transpose(), f = forces.row(i).transpose();
      sum += Eigen::RowVector4d(f.x(), f.y(), f.z(), y.dot(f)) / (x - y).norm();
    }
    return sum;
  }
};

/// Centres in all directions, including the axis and its normal plane; more than are rotated in one batch.
std::vector<Vector3> centres(double distance) {
  std::vector<Vector3> result{{0, 0, distance}, {0, 0, -distance}, {distance, 0, 0}, {0, -distance, 0}};
  const Matrix directions = random_points(33, 7);
  for (Index i = 0; i < directions.rows(); ++i) result.emplace_back(distance * directions.row(i).normalized());
  return result;
}

/// Largest difference from the sums over all points, for a unit force.
double error(const AxisTranslation& translation, const std::vector<Cloud>& clouds, int degree, Index columns) {
  std::vector<RowMatrix> charges;
  for (const Cloud& cloud : clouds) charges.emplace_back(cloud.moments.leftCols(columns));
  std::vector<DistantMoments> sources;
  for (std::size_t i = 0; i < clouds.size(); ++i) sources.push_back({&charges[i], -clouds[i].centre, degree});
  const Matrix targets = random_points(6, 3);
  const Matrix found = regular_harmonics(targets, kHighest) * translation.local(sources, columns);
  double largest = 0.0;
  for (Index k = 0; k < targets.rows(); ++k) {
    Eigen::RowVector4d exact = Eigen::RowVector4d::Zero();
    for (const Cloud& cloud : clouds) exact += cloud.at(targets.row(k).transpose());
    largest = std::max(largest, (found.row(k) - exact.head(columns)).cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(potentials_of_many_clouds_are_the_sums_over_their_points) {
  const AxisTranslation translation(kHighest);
  std::vector<Cloud> clouds;
  for (const Vector3& centre : centres(7.0)) clouds.emplace_back(translation, centre, 20 + unsigned(clouds.size()));
  for (const Index columns : {1, 4}) BOOST_TEST(error(translation, clouds, kHighest, columns) < 1e-12);
}

BOOST_AUTO_TEST_CASE(truncation_falls_like_the_ratio_of_radius_and_distance) {
  const AxisTranslation translation(kHighest);
  for (const double distance : {3.0, 4.0}) {
    for (const Vector3& centre : {Vector3(0.48, -0.6, 0.64), Vector3(0.0, 0.0, -1.0)}) {
      const std::vector<Cloud> one{Cloud(translation, distance * centre, 5)};
      for (const int degree : {4, 8, 16, 24}) {
        const double bound = 6.0 * std::pow(distance - 1.0, -degree - 1) / (distance - 2.0);
        BOOST_TEST(error(translation, one, degree, 1) < bound, "degree " << degree << " distance " << distance);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
