#pragma once

#include <optional>
#include <vector>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// Response of the membrane forces that depend on the unknowns: velocity u = S[F h + 2 λ_0 h n + T λ]/μ, through the
/// velocity map of a viscosity contrast if there is one, of a curvature increment h (F of Eq. (28a)) and a tension λ (T
/// of Eq. (28c)). Scalars of degree p replace the three components of x^{n+1}: (27a) needs x^{n+1} only through
/// H^{n+1}. The held tension λ_0 is what the change of H does to a tension that is there already; the paper's scheme
/// leaves it out, deferred corrections converge the better the more of the true response is implicit.
/// Source: paper Eqs. (27), (28)
struct MembraneUnknowns {
  Vector curvature;  ///< h, of degree p or more; empty without bending
  Vector tension;    ///< λ; empty unless inextensible, without its first coefficient where the area is free
};

/// u with its derivatives on the upsampled grid, where nobody asks for its values.
struct VelocityField {
  Matrix coefficients;
  SphereDerivatives derivatives;  ///< second ones only where bending needs them
};

/// A velocity given by its coefficients, [n_coefficients x 3], on the upsampled grid.
VelocityField velocity_field(const Membrane& membrane, const Matrix& coefficients, bool hessian);

/// What h is known by and what it does to the tension that is there.
struct CurvatureOptions {
  Vector held_tension{};  ///< λ_0 on the upsampled grid; empty: zero
  /// Between a degree above p and the upsampled grid; empty: h has degree p. Positions of degree p have normal
  /// parts, and H, of the next one. Bending does nothing to that, but tension does, and it has to be implicit as well:
  /// at large λ dt/(μR) equilibria are unstable without it.
  std::optional<SphereTransform> transform{};

  /// To the degree of h: p where there is no tension that more of it could act on.
  [[nodiscard]] const SphereTransform& of(const Membrane& membrane) const {
    return transform && held_tension.size() > 0 ? *transform : membrane.fine;
  }
  /// To the degree of FlowOptions::entries.
  [[nodiscard]] const SphereTransform& all(const Membrane& membrane) const {
    return transform ? *transform : membrane.fine;
  }
};

/// u of the unknowns, coefficients. F acts on the degrees of h up to p.
/// Source: paper Eqs. (5), (28a), (28c)
Matrix membrane_velocity(const FlowParameters& parameters, const Membrane& membrane, const MembraneUnknowns& unknowns,
                         const CurvatureOptions& curvature = {});

/// Right-hand side of the coupled system: h − dt Hop(u) = curvature, J ∇_γ·u = divergence for u = membrane_velocity.
/// With undulations the area is free: J (∇_γ·u − e) = divergence, where the dilation e is an unknown in place of the
/// first coefficient of λ.
struct FlowRightHandSide {
  Vector curvature;
  Vector divergence;  ///< weighted
};

/// What the system leaves out and what it holds.
struct FlowOptions {
  CurvatureOptions curvature{};
  /// Coefficients of h and, up to degree p, of λ that can differ from zero, ascending; empty: all.
  std::vector<Index> entries{};
};

/// Which scalars are unknown, and with which coefficients. The solver sees each scalar over its own natural scale, so
/// that its norm adds like to like: one step of size dt bends a membrane of radius R by h R and strains it by
/// λ dt/(μR), or by λ R²/κ_B where bending answers within the step.
struct FlowLayout {
  Index n_all = 0;             ///< coefficients of the degree of the entries
  Index n_curved = 0;          ///< of the degree of h
  Index n_resolved = 0;        ///< of degree p; λ has no others
  std::vector<Index> entries;  ///< those that can differ from zero
  bool bending = false;
  bool tension = false;
  double curvature_scale = 1.0;  ///< 1/R
  double tension_scale = 1.0;  ///< a share of μR/dt + κ_B/R²; where λ is the only unknown its scale is of no account
  Vector of_dilation{};        ///< −J/(μR), entries of λ, where the area is free; else empty

  [[nodiscard]] Index n() const { return static_cast<Index>(entries.size()); }
  /// Is the i-th of the entries one of h, or of λ? The others are zero.
  [[nodiscard]] bool is_curvature(Index i) const { return entries[static_cast<std::size_t>(i)] < n_curved; }
  [[nodiscard]] bool is_tension(Index i) const { return entries[static_cast<std::size_t>(i)] < n_resolved; }
  [[nodiscard]] Index n_curvature() const { return bending ? n() : 0; }
  [[nodiscard]] Index n_tension() const { return tension ? n() : 0; }
  [[nodiscard]] Index size() const { return n_curvature() + n_tension(); }
};

/// True where a uniform tension moves nothing, that is, on a sphere: there the constraint does not determine it, and
/// the area cannot change at constant volume. With undulations the area determines it.
/// @param membrane  a sphere up to rounding, or not
bool uniform_tension_is_free(const FlowParameters& parameters, const Membrane& membrane);

/// The semi-implicit system (27) with (28) for the increments (h, λ) on one frozen membrane, preconditioned with its
/// exact inverse on the sphere of the same area for the actual κ_B, both viscosities and dt. A solve recycles the
/// search directions of former ones, also of those on other membranes and for other dt. Accuracy: the tolerance of the
/// solve; solutions satisfy the system to 1e-8, in at most 40 iterations at every ratio of viscosities
/// (tests/stepping/solve/flow_system_test.cpp) Source: paper Eqs. (27), (28); preconditioned with the spectrum of the
/// sphere as Veerapaneni et al. 2011
class FlowSystem {
 public:
  /// @param membrane  must outlive the system
  /// @param known     of RecycledSubspaces; forgotten if it is of another degree
  FlowSystem(const FlowParameters& parameters, const Membrane& membrane, double dt, const FlowOptions& options = {},
             RecycledSubspace known = {});

  struct Solution {
    SolveReport report;
    MembraneUnknowns unknowns;
    Matrix velocity;  ///< membrane_velocity of the unknowns, [n_coefficients x 3]
  };
  /// @param start      unknowns from which the solve starts; those that are empty are zero
  /// @param tolerance  of the preconditioned residual, relative to the preconditioned right-hand side
  Solution solve(const FlowRightHandSide& rhs, const MembraneUnknowns& start, double tolerance);

  /// What a uniform tension of 1 leads to where the area is free: h, λ and velocity, whose ∇_γ·u is uniform. Solved for
  /// once.
  const Solution& of_uniform_tension(double tolerance);

  /// Between the degree of h and the upsampled grid.
  [[nodiscard]] const SphereTransform& curvature_transform() const { return curvature_; }
  /// What its own solves have learned, in the form of RecycledSubspaces.
  [[nodiscard]] RecycledSubspace learned() const;
  /// Of what was known before, what it has kept.
  [[nodiscard]] RecycledSubspace kept() const;

 private:
  FlowLayout layout_;
  SphereTransform curvature_;
  double dt_;
  FlowParameters parameters_;
  const Membrane& membrane_;
  CurvatureOptions curvature_options_;
  RecycledSubspace known_;
  RecycledGcr solver_;
  std::optional<Solution> of_uniform_tension_;
};

}  // namespace vehd
