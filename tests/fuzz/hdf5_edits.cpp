#include "tests/fuzz/hdf5_edits.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/run_file.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/files/sealed_file.hpp"
#include "bie/runs/checkpoint.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/seals.hpp"

namespace fuzz {
namespace {

constexpr int order = 4;
constexpr const char* scene_text =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n[membrane]\nbending_modulus = 0.1\n"
    "[electric]\nfield = [0.0, 0.0, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
    "[numerics]\norder = 4\ndt = 0.25\nend_time = 1.0\n";

constexpr std::array paths = {"/",
                              "/scene",
                              "/totals",
                              "/grid",
                              "/state",
                              "/state/position",
                              "/state/tension",
                              "/state/area_strain",
                              "/snapshots",
                              "/snapshots/000000",
                              "/snapshots/000001",
                              "/snapshots/000000/x",
                              "/snapshots/000000/coefficients",
                              "/snapshots/000000/coefficients/x",
                              "/snapshots/000000/coefficients/Vm",
                              "/snapshots/000000/surface/x",
                              "/snapshots/000001/coefficients",
                              "/snapshots/000001/coefficients/x",
                              "/snapshots/000001/coefficients/velocity",
                              "/snapshots/9",
                              "/state/tension_entries",
                              "/state/tension_arguments",
                              "/state/tension_responses",
                              "/state/flow_entries",
                              "/state/flow_arguments",
                              "/state/flow_responses",
                              "/state/past",
                              "/state/past_times"};
constexpr std::array attributes = {"schema_version", "time",    "step",     "checksum", "n_rows",
                                   "threads",        "dt_next", "dt_found", "pause",    "unaided_iterations"};
constexpr std::array<double, 8> written_values = {0.0,    1.0,
                                                  -1.0,   0.25,
                                                  1e300,  std::numeric_limits<double>::infinity(),
                                                  5e-324, std::numeric_limits<double>::quiet_NaN()};
constexpr std::array<hsize_t, 16> extents = {
    0, 1, 2, 3, 4, 5, 10, 16, 25, 36, 4225, 4356, 0xffffffff, hsize_t{1} << 40, hsize_t{1} << 62, 7};

/// Numbers taken from bytes; zeros after the end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  unsigned next() {
    if (bytes_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte;
  }
  template <typename Array>
  auto pick(const Array& array) {
    return array[next() % array.size()];
  }

 private:
  std::string_view bytes_;
};

vehd::Matrix ellipsoid() {
  vehd::Matrix position = vehd::Matrix::Zero(vehd::n_coefficients(order), 3);
  for (vehd::Index axis = 0; axis < 3; ++axis) position(axis + 1, axis) = 2.0;
  return position;
}

std::string good_run() {
  const vehd::SphereTransform transform(order, vehd::make_grid(order));
  vehd::Hdf5Writer file("run.h5", vehd::Hdf5Writer::Mode::in_memory);
  vehd::write_run_header(file, transform, {scene_text, 1, vehd::si_units_of(std::nullopt)});
  file.seal("/");
  vehd::State state;
  state.vesicles.emplace_back();
  state.vesicles[0].position = ellipsoid();
  state.vesicles[0].transmembrane_potential = vehd::Vector::Ones(state.vesicles[0].position.rows());
  vehd::Fields fields{std::vector<vehd::VesicleFields>(1)};
  fields.vesicles[0].velocity = state.vesicles[0].position;
  for (const char* name : {"000000", "000001"}) {
    vehd::write_snapshot(file, name, transform, state, fields, vehd::si_units_of(std::nullopt));
    state.time += 1.0;
  }
  return file.image();
}

std::string good_checkpoint() {
  const TemporaryDirectory directory;
  vehd::Checkpoint checkpoint;
  checkpoint.scene = scene_text;
  checkpoint.start_order = vehd::lowest_order;
  checkpoint.state.vesicles.emplace_back();
  checkpoint.state.vesicles[0].position = ellipsoid();
  checkpoint.state.vesicles[0].tension = vehd::Vector::Ones(checkpoint.state.vesicles[0].position.rows());
  checkpoint.state.vesicles[0].area_strain = vehd::Vector::Zero(checkpoint.state.vesicles[0].position.rows());
  const vehd::Matrix columns = vehd::Matrix::Identity(2 * checkpoint.state.vesicles[0].position.rows(), 3);
  std::vector<vehd::Index> entries(static_cast<std::size_t>(checkpoint.state.vesicles[0].position.rows()));
  std::iota(entries.begin(), entries.end(), vehd::Index{0});
  checkpoint.state.vesicles[0].recycled.flow = vehd::recycled_scalars(entries, {columns, columns});
  checkpoint.state.vesicles[0].recycled.tension = checkpoint.state.vesicles[0].recycled.flow;
  vehd::write_checkpoint(directory / "checkpoint.h5", checkpoint);
  return vehd::read_sealed_file(directory / "checkpoint.h5");
}

vehd::Hdf5Handle open_image(const std::string& image) {
  vehd::silence_hdf5();
  const vehd::Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V110);
  H5Pset_fapl_core(access.id(), 1 << 16, false);
  H5Pset_file_image(access.id(), const_cast<char*>(image.data()), image.size());
  return {H5Fopen("image", H5F_ACC_RDWR, access.id()), H5Fclose};
}

std::string image_of(hid_t file) {
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  H5Fget_file_image(file, image.data(), image.size());
  return image;
}

hid_t type_of(unsigned choice) {
  const std::array types = {H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_STD_U8LE, H5T_C_S1};
  return types[choice % types.size()];
}

/// Puts a dataset in place of any object of its name. Only small ones get values; others claim a size without data.
void put_dataset(hid_t file, Bytes& bytes) {
  const char* path = bytes.pick(paths);
  const hid_t type = type_of(bytes.next());
  std::vector<hsize_t> size(bytes.next() % 6);
  hsize_t count = 1;
  for (hsize_t& extent : size) {
    extent = bytes.pick(extents);
    count = extent == 0 || count > 100000 / extent ? 0 : count * extent;
  }
  const double value = bytes.pick(written_values);
  const vehd::Hdf5Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const vehd::Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (bytes.next() % 2 == 1 && count > 0 && !size.empty()) H5Pset_chunk(properties.id(), int(size.size()), size.data());
  H5Ldelete(file, path, H5P_DEFAULT);
  const vehd::Hdf5Handle dataset(H5Dcreate2(file, path, type, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                                 H5Dclose);
  if (!dataset.valid() || count == 0 || type == H5T_C_S1) return;
  const std::vector<double> values(count, value);
  H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

void put_text(hid_t file, Bytes& bytes) {
  const char* path = bytes.pick(paths);
  std::string text(bytes.next() % 64, '\0');
  for (char& letter : text) letter = static_cast<char>(bytes.next());
  const vehd::Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), text.empty() ? H5T_VARIABLE : text.size());
  const vehd::Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Ldelete(file, path, H5P_DEFAULT);
  const vehd::Hdf5Handle dataset(H5Dcreate2(file, path, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                 H5Dclose);
  const char* pointer = "text";
  H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
           text.empty() ? static_cast<const void*>(&pointer) : text.data());
}

void put_attribute(hid_t file, Bytes& bytes) {
  const char* path = bytes.pick(paths);
  const char* name = bytes.pick(attributes);
  const hsize_t size = 1 + bytes.next() % 3;
  const std::vector<double> values(size, bytes.pick(written_values));
  const vehd::Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  H5Adelete_by_name(file, path, name, H5P_DEFAULT);
  const vehd::Hdf5Handle attribute(
      H5Acreate_by_name(file, path, name, type_of(bytes.next()), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
}

/// Renews the seals, so that the code behind their check is reached.
void correct_seals(const std::string& image, hid_t file) {
  for (const char* group : {"/", "/snapshots/000000", "/snapshots/000001"}) {
    try {
      const std::string seal = vehd::testing::seal_of(vehd::Hdf5Reader(image, "run.h5"), group);
      vehd::testing::put_text(file, vehd::seal_path(group), seal);
    } catch (const vehd::InputError&) {
    }
  }
}

void edit(hid_t file, Bytes& bytes) {
  switch (bytes.next() % 7) {
    case 0:
      H5Ldelete(file, bytes.pick(paths), H5P_DEFAULT);
      break;
    case 1:
      put_dataset(file, bytes);
      break;
    case 2:
      put_text(file, bytes);
      break;
    case 3:
      put_attribute(file, bytes);
      break;
    case 4: {
      const char* path = bytes.pick(paths);
      H5Adelete_by_name(file, path, bytes.pick(attributes), H5P_DEFAULT);
      break;
    }
    case 5: {
      const char* target = bytes.pick(paths);
      H5Lcreate_soft(target, file, bytes.pick(paths), H5P_DEFAULT, H5P_DEFAULT);
      break;
    }
    case 6: {
      const vehd::Hdf5Handle group(H5Gcreate2(file, bytes.pick(paths), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                   H5Gclose);
      break;
    }
  }
}

}  // namespace

EditedFile edited_file(std::string_view text) {
  static const std::string run = good_run(), checkpoint = good_checkpoint();
  Bytes bytes(text);
  EditedFile result;
  const unsigned start = bytes.next();
  result.is_checkpoint = start % 2 == 1;
  vehd::Hdf5Handle file = open_image(result.is_checkpoint ? checkpoint : run);
  for (int count = 0; !bytes.empty() && count < 32; ++count) edit(file.id(), bytes);
  result.image = image_of(file.id());
  if (result.is_checkpoint || (start & 2U) != 0) return result;
  correct_seals(result.image, file.id());
  result.image = image_of(file.id());
  return result;
}

}  // namespace fuzz
