#include "bie/physics/unknowns.hpp"

namespace vehd {

namespace {

template <typename Field>
void axpy(double weight, const Field& x, Field& y) {
  if (x.size() == 0) return;
  if (y.size() == 0) {
    y = weight * x;
  } else {
    y += weight * x;
  }
}

}  // namespace

void axpy(double weight, const Unknowns& x, Unknowns& y) {
  axpy(weight, x.position, y.position);
  axpy(weight, x.transmembrane_potential, y.transmembrane_potential);
  axpy(weight, x.free_charge, y.free_charge);
  axpy(weight, x.poration, y.poration);
}

Unknowns operator-(const Unknowns& a, const Unknowns& b) {
  Unknowns difference = a;
  axpy(-1.0, b, difference);
  return difference;
}

}  // namespace vehd
