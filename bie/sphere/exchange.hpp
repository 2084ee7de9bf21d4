#pragma once

#include <cstddef>
#include <vector>

#include "bie/sphere/reflection.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// A map of space that leaves the origin where it is: a product of mirrors, then a turn about z.
struct Isometry {
  Reflection reflection{};
  int turn = 0, fold = 1;  ///< by 2π turn/fold

  /// A x of the map x ↦ A x.
  [[nodiscard]] Matrix3 matrix() const;
};

/// Fields on the image of a body under a map g, whose parametrisation is x'(g s) = g x(s).
/// Accuracy: exact for reflections, rounding for turns (tests/sphere/images_of_fields_test.cpp)
struct ImageOfFields {
  Isometry map{};
  int potential_sign = 1;  ///< of V_m, which changes its sign where the map reverses the field

  /// f'(g s) = f(s), coefficients; nothing of an empty field. Columns are fields of their own.
  [[nodiscard]] Matrix scalar(const Matrix& field) const;
  /// The same of fields that take the sign of V_m, as charges do.
  [[nodiscard]] Matrix potential(const Matrix& field) const;
  /// v'(g s) = g v(s), [n_coefficients x 3].
  [[nodiscard]] Matrix vector(const Matrix& field) const;
};

/// Equal bodies that change places under symmetries of the whole: a group of maps under which each body either stays
/// where it is or has as many images as there are maps. Of those that are images of one another only the first, their
/// original, has to be computed. By default no body is the image of another one.
class Exchange {
 public:
  /// One of the maps.
  struct Map {
    ImageOfFields of_fields;
    std::vector<std::size_t> places;  ///< of each body the one that it is taken to
  };

  Exchange() = default;
  /// @param maps  a group, the identity first
  explicit Exchange(std::vector<Map> maps);

  /// Is any body the image of another one?
  [[nodiscard]] bool any() const { return !bodies_.empty(); }
  /// Of turns by 2π/fold about z; 1 where the maps are others.
  [[nodiscard]] int fold() const { return maps_.back().of_fields.map.fold; }
  /// The maps but for the identity.
  [[nodiscard]] std::vector<Isometry> maps() const;
  /// Of each body the one that it is an image of, or itself; empty where there are no images.
  [[nodiscard]] const std::vector<std::size_t>& originals() const { return originals_; }
  [[nodiscard]] std::size_t original(std::size_t body) const { return any() ? originals_[body] : body; }
  [[nodiscard]] bool is_image(std::size_t body) const { return original(body) != body; }
  /// How many of n bodies are no images.
  [[nodiscard]] std::size_t n_originals(std::size_t n) const;
  /// Maps fields of its original to those of a body.
  [[nodiscard]] const ImageOfFields& image(std::size_t body) const { return map_of(body).of_fields; }
  /// The body that the map which makes `image` from its original takes to `body`: what the image does to the one, its
  /// original does to the other.
  [[nodiscard]] std::size_t preimage(std::size_t image, std::size_t body) const;

 private:
  [[nodiscard]] const Map& map_of(std::size_t body) const { return maps_[any() ? bodies_[body] : 0]; }

  std::vector<Map> maps_{1};
  std::vector<std::size_t> bodies_;  ///< of each the number of the map from its original
  std::vector<std::size_t> originals_;
};

}  // namespace vehd
