#pragma once

#include <cstddef>
#include <vector>

#include "bie/sphere/reflection.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Isometry of space that fixes the origin: a product of mirrors, then a rotation about z.
struct Isometry {
  Reflection reflection{};
  int turn = 0, fold = 1;  ///< by 2π turn/fold

  /// Matrix A of the map x ↦ A x.
  [[nodiscard]] Matrix3 matrix() const;
};

/// Maps fields on a body to those on its image under a map g, whose parametrisation is x'(g s) = g x(s).
/// Accuracy: exact for reflections, rounding for rotations (tests/sphere/images_of_fields_test.cpp)
struct ImageOfFields {
  Isometry map{};
  int potential_sign = 1;  ///< of V_m: −1 if the map reverses the electric field

  /// f'(g s) = f(s).
  /// @param field  coefficients, [n_coefficients x n_fields], or empty
  /// @return       coefficients of the same shape
  /// @throws ShapeError if the number of rows is not (p + 1)²
  [[nodiscard]] Matrix scalar(const Matrix& field) const;
  /// scalar() times potential_sign, for V_m, potentials and charges, [n_coefficients x n_fields].
  [[nodiscard]] Matrix potential(const Matrix& field) const;
  /// v'(g s) = g v(s), coefficients of Cartesian components, [n_coefficients x 3], or empty.
  [[nodiscard]] Matrix vector(const Matrix& field) const;
};

/// Permutations of equal bodies by the symmetries of a scene: a group of maps under which each body either stays where
/// it is or has as many images as there are maps. Of bodies that are images of one another only the first, their
/// original, is computed. By default no body is the image of another.
class Exchange {
 public:
  /// A map of the group, with its effect on fields and bodies.
  struct Map {
    ImageOfFields of_fields;
    std::vector<std::size_t> places;  ///< for each body, the index of its image
  };

  Exchange() = default;
  /// @param maps  a group, the identity first
  explicit Exchange(std::vector<Map> maps);

  /// Is any body the image of another one?
  [[nodiscard]] bool any() const { return !bodies_.empty(); }
  /// The group contains the rotations by multiples of 2π/fold about z; 1 without rotations.
  [[nodiscard]] int fold() const { return maps_.back().of_fields.map.fold; }
  /// All maps except the identity.
  [[nodiscard]] std::vector<Isometry> maps() const;
  /// Original of each body (the body itself unless it is an image); empty without images.
  [[nodiscard]] const std::vector<std::size_t>& originals() const { return originals_; }
  [[nodiscard]] std::size_t original(std::size_t body) const { return any() ? originals_[body] : body; }
  [[nodiscard]] bool is_image(std::size_t body) const { return original(body) != body; }
  /// Number of the n bodies that are not images.
  [[nodiscard]] std::size_t n_originals(std::size_t n) const;
  /// Map from the fields of the original to those of a body.
  [[nodiscard]] const ImageOfFields& image(std::size_t body) const { return map_of(body).of_fields; }
  /// g⁻¹(body), where g maps the original of `image` to `image`: the action of `image` on `body` is that of the
  /// original on g⁻¹(body).
  [[nodiscard]] std::size_t preimage(std::size_t image, std::size_t body) const;

 private:
  [[nodiscard]] const Map& map_of(std::size_t body) const { return maps_[any() ? bodies_[body] : 0]; }

  std::vector<Map> maps_{1};
  std::vector<std::size_t> bodies_;  ///< for each body, the index of the map from its original
  std::vector<std::size_t> originals_;
};

}  // namespace vehd
