#include "bie/comparison/frozen_state.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/comparison/check_fields.hpp"
#include "bie/files/run_file.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/run_damage.hpp"

BOOST_AUTO_TEST_SUITE(frozen_state)

using namespace vehd::testing;

namespace {

const std::string start =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.1, 1.3]\n[membrane]\nbending_modulus = 0.1\nconductance = 1.0\n"
    "[flow]\nkind = 'shear'\nrate = 1.0\n"
    "[electric]\nfield = [0.0, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity = 1.0\n";
const std::string numerics = "[numerics]\norder = 4\ndt = 0.1\nend_time = 0.0\n";

/// The run.h5 of a scene, holding only its start.
class StartedRun {
 public:
  explicit StartedRun(const std::string& scene) {
    write_text(directory_ / "scene.toml", scene);
    const vehd::FrozenState frozen = vehd::read_frozen_state({directory_ / "scene.toml", {}}, std::nullopt);
    const int order = frozen.settings.order;
    const vehd::SphereTransform transform(order, vehd::make_grid(order));
    const vehd::SiUnits units = vehd::si_units_of(std::nullopt);
    vehd::Hdf5Writer file(path, vehd::Hdf5Writer::Mode::create);
    vehd::write_run_header(file, transform, {scene, 1, units});
    vehd::write_snapshot(file, vehd::snapshot_name(0), transform, frozen.state, frozen.fields, units);
    file.close();
    const vehd::Hdf5Reader reader(path);
    vesicles = vehd::vesicle_groups(reader, group);
    fields = reader.members(vesicles.front() + "/coefficients");
  }

  /// Changes a copy and reseals it if possible. @returns why it is refused; "" if it is read
  [[nodiscard]] std::string refusal(const std::function<void(hid_t)>& change) {
    const std::string copy = directory_ / "damaged.h5";
    std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
    { change(open_for_damage(copy).id()); }
    try {
      reseal(copy, "/");
      reseal(copy, group);
    } catch (const std::runtime_error&) {
      // An object that enters the checksum is missing.
    }
    try {
      const vehd::FrozenState frozen = read(copy);
      BOOST_TEST(numbers_of(frozen) == numbers_of(read(path)));
    } catch (const vehd::InputError& error) {
      BOOST_TEST(std::string(error.what()).starts_with(copy + ": "), error.what());
      return std::string(error.what()).substr(copy.size() + 2);
    }
    return "";
  }
  [[nodiscard]] std::string shape_refusal() const {
    try {
      vehd::read_frozen_shape(directory_ / "damaged.h5", std::nullopt);
    } catch (const vehd::InputError& error) {
      return error.what();
    }
    return "";
  }

  const std::string group = "/snapshots/000000";
  std::vector<std::string> vesicles, fields;

 private:
  static vehd::FrozenState read(const std::string& file) { return vehd::read_frozen_state({file, {}}, std::nullopt); }
  /// All numbers that were read, in one sequence.
  static std::vector<double> numbers_of(const vehd::FrozenState& frozen) {
    std::vector<double> all;
    const auto take = [&](const vehd::Matrix& m) { all.insert(all.end(), m.data(), m.data() + m.size()); };
    for (const vehd::VesicleState& v : frozen.state.vesicles) {
      take(v.position);
      for (const vehd::Vector* scalar : {&v.transmembrane_potential, &v.free_charge, &v.poration,
                                         &v.material.capacitance, &v.material.conductance, &v.material.pump_current}) {
        take(*scalar);
      }
    }
    for (const vehd::VesicleFields& f : frozen.fields.vesicles) {
      for (const vehd::Matrix* vector :
           {&f.velocity, &f.force_bending, &f.force_tension, &f.force_electric, &f.force_contact}) {
        take(*vector);
      }
      for (const vehd::Vector* scalar :
           {&f.tension, &f.charge, &f.potential, &f.conductance, &f.free_charge_in, &f.free_charge_out}) {
        take(*scalar);
      }
    }
    return all;
  }

  TemporaryDirectory directory_;

 public:
  const std::string path = directory_ / "run.h5";
};

}  // namespace

// Regression: a missing field was read as an empty one, and the check ended elsewhere.
BOOST_AUTO_TEST_CASE(fields_that_are_missing_or_have_another_name_are_named) {
  const std::string varying =
      "[membrane.varying_capacitance]\nkind = 'harmonics'\nmodes = [{n = 1, m = 0, a = 0.1}]\n"
      "[membrane.varying_conductance]\nkind = 'harmonics'\nmodes = [{n = 2, m = 0, a = 0.1}]\n";
  const std::string pores =
      "[poration]\nmodel = 'porosity'\nthreshold_Vm = 1.0\nporated_conductance = 1.0\nporation_time = 1.0\n"
      "resealing_time = 2.0\n";
  const std::string pair =
      "[contact]\nenergy = 0.1\nrange = 0.5\n[[vesicle]]\nname = 'left'\n[[vesicle]]\nname = "
      "'right'\nshape.centre = [3.0, 0.0, 0.0]\n";
  for (const std::string& scene : {start + numerics, start + "displacement_current = true\n" + numerics,
                                   start + varying + numerics, start + pores + numerics, start + numerics + pair}) {
    StartedRun run(scene);
    for (const std::string& vesicle : run.vesicles) {
      for (const std::string& field : run.fields) {
        const std::string dataset = vesicle + "/coefficients/" + field;
        // This field is written for pictures and for other programs.
        const bool is_read = field != "area_strain";
        for (const char* new_name : {"", "2"}) {
          const std::string refusal = run.refusal([&](hid_t file) {
            const std::string other = dataset + new_name;
            const herr_t status = other == dataset
                                      ? H5Ldelete(file, dataset.c_str(), H5P_DEFAULT)
                                      : H5Lmove(file, dataset.c_str(), file, other.c_str(), H5P_DEFAULT, H5P_DEFAULT);
            BOOST_TEST_REQUIRE(status >= 0, dataset);
          });
          BOOST_TEST((refusal.find(dataset + " ") != std::string::npos) == is_read, dataset + ": " + refusal);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(groups_attributes_and_scenes_that_are_missing_are_named) {
  StartedRun run(start + numerics);
  for (const std::string object : {"/snapshots", "/snapshots/000000", "/snapshots/000000/coefficients", "/scene"}) {
    const std::string refusal = run.refusal([&](hid_t file) { H5Ldelete(file, object.c_str(), H5P_DEFAULT); });
    BOOST_TEST(refusal != "", object);
  }
  for (const auto& [object, attribute] : {std::pair{"/", "schema_version"}, std::pair{"/snapshots/000000", "time"},
                                          std::pair{"/snapshots/000000", "step"}}) {
    const std::string refusal =
        run.refusal([&](hid_t file) { H5Adelete_by_name(file, object, attribute, H5P_DEFAULT); });
    BOOST_TEST(refusal.find(attribute) != std::string::npos, refusal);
  }
}

BOOST_AUTO_TEST_CASE(scene_of_other_vesicles_than_the_snapshots_have_is_refused) {
  const std::string pair = "[[vesicle]]\nname = 'left'\n[[vesicle]]\nname = 'right'\nshape.centre = [3.0, 0.0, 0.0]\n";
  StartedRun of_one(start + numerics), of_two(start + numerics + pair);
  const auto take_scene_of = [](const StartedRun& other) {
    return [&](hid_t file) {
      const vehd::Hdf5Handle source = open_for_damage(other.path);
      BOOST_TEST_REQUIRE(H5Ldelete(file, "/scene", H5P_DEFAULT) >= 0);
      BOOST_TEST_REQUIRE(H5Ocopy(source.id(), "/scene", file, "/scene", H5P_DEFAULT, H5P_DEFAULT) >= 0);
    };
  };
  BOOST_TEST(of_one.refusal(take_scene_of(of_two)) == "has 1 vesicle in its snapshots, and its scene has 2");
  BOOST_TEST(of_two.refusal(take_scene_of(of_one)) == "has 2 vesicles in its snapshots, and its scene has 1");
}

// Regression: a mesher failed without naming the file, or a solve ended with "relative residual -nan".
BOOST_AUTO_TEST_CASE(shapes_that_enclose_nothing_are_named) {
  StartedRun run(start + numerics);
  const std::string dataset = run.group + "/coefficients/x";
  const auto refusal = [&](const std::function<double(double)>& change) {
    const std::string text = run.refusal([&](hid_t file) { change_dataset(file, dataset, change); });
    BOOST_TEST(run.shape_refusal().ends_with(text), run.shape_refusal());
    return text;
  };
  BOOST_TEST(refusal([](double x) { return -x; }).starts_with("x at time 0 encloses the volume -5.98997;"));
  BOOST_TEST(refusal([](double) { return 0.0; }) ==
             "x at time 0 is not a surface: its area element vanishes somewhere");
  BOOST_TEST(refusal([](double x) { return 1e200 * x; }) ==
             "x at time 0 is too large: its area or its volume is not finite");
}

BOOST_AUTO_TEST_CASE(fields_that_the_elements_do_not_support_are_refused) {
  const TemporaryDirectory directory;
  const std::string alone =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1.2]\n[numerics]\ndegree = 4\ndt = 0.1\nend_time = 1\n"
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
  const auto message = [&](const std::string& more) {
    write_text(directory / "scene.toml", alone + more);
    try {
      vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
    } catch (const vehd::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(message("") == "");
  const std::string waveform = "[electric.waveform]\nkind = \"ac\"\nfrequency = 1\n";
  BOOST_TEST(message(waveform) == "");
  BOOST_TEST(message(waveform + "average = true\n").find("averaged ac field") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n") == "");
  const std::string poration = "[poration]\nthreshold_Vm = 1\nmodel = ";
  BOOST_TEST(message(poration + "\"porosity\"\nporated_conductance = 1\nporation_time = 1\nresealing_time = 2\n") ==
             "");
  BOOST_TEST(message(poration + "\"criterion\"\n") == "");
  const auto varying = [](const std::string& property) {
    return "[membrane]\nbending_modulus = 0.1\nconductance = 1\n[membrane.varying_" + property +
           "]\nkind = \"harmonics\"\nmodes = [{n = 1, m = 0, a = 0.1}]\n";
  };
  BOOST_TEST(message(varying("capacitance")) == "");
  BOOST_TEST(message(varying("conductance")) == "");
  BOOST_TEST(message("displacement_current = true\n" + varying("conductance")) == "");
  BOOST_TEST(message(varying("bending")).find("spatially varying bending modulus") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n" + varying("capacitance")).find("displacement currents") !=
             std::string::npos);
}

namespace {

/// A run of degree 12 that was solved in degree 8: its higher coefficients are zero.
void write_padded_run(const std::string& path, const std::string& scene, const vehd::FrozenState& solved) {
  const vehd::SphereTransform transform(12, vehd::make_grid(12));
  vehd::Hdf5Writer file(path, vehd::Hdf5Writer::Mode::create);
  const vehd::SiUnits units = vehd::si_units_of(std::nullopt);
  vehd::write_run_header(file, transform, {scene, 1, units});
  file.seal("/");
  vehd::write_snapshot(file, vehd::snapshot_name(0), transform, solved.state, solved.fields, units);
  file.close();
}

}  // namespace

// With a tolerance the file has the highest degree, and a state is solved in a lower one. Regression: recomputed in the
// degree of the file, every number differed by the truncation of the lower one.
BOOST_AUTO_TEST_CASE(snapshot_has_the_degree_that_it_was_solved_in) {
  const TemporaryDirectory directory;
  const auto scene = [](const std::string& numerics) {
    return "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.2, 1.5]\n[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
           "[flow]\nkind = 'shear'\nrate = 1.0\n"
           "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = 'steady'\n"
           "[numerics]\nend_time = 0.0\n" +
           numerics;
  };
  write_text(directory / "scene.toml", scene("degree = 8\ndt = 0.1\n"));
  const vehd::FrozenState solved = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  write_padded_run(directory / "run.h5", scene("degree = 12\ntolerance = 1e-3\n"), solved);

  const vehd::FrozenState read = vehd::read_frozen_state({directory / "run.h5", {}}, std::nullopt);
  const vehd::VesicleFields& stored = read.fields.vesicles.front();
  BOOST_TEST(vehd::order_of(read.state.vesicles.front().position.rows()) == 8);
  BOOST_TEST(vehd::order_of(stored.force_bending.rows()) == 8);
  vehd::CheckProblem problem = vehd::check_problem(read);
  problem.samples = {};
  const auto differences = [&](int order) {
    const vehd::CheckFields fields = vehd::check_fields(problem, {order}).front();
    const auto relative = [&](const vehd::Matrix& found, const vehd::Matrix& expected) {
      return (found - vehd::resize_order(expected, order)).norm() / expected.norm();
    };
    return std::vector<double>{
        relative(fields.charge, stored.charge), relative(fields.force_electric, stored.force_electric),
        relative(fields.force_bending, stored.force_bending), relative(fields.tension, stored.tension)};
  };
  for (const double difference : differences(8)) BOOST_TEST(difference < 1e-5);
  for (const double difference : differences(12)) BOOST_TEST(difference > 1e-4);
}

// Regression: A_0 was the one that reproduces the stored tension, so no row judged σ(A).
BOOST_AUTO_TEST_CASE(stored_tension_is_that_of_the_law_of_undulations_in_the_scene) {
  const TemporaryDirectory directory;
  const auto scene = [](const std::string& modulus, const std::string& numerics) {
    return "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.2, 1.5]\n"
           "[membrane]\nbending_modulus = 0.1\nundulations = true\nrest_area = 18.5\nstretching_modulus = " +
           modulus + "\n[flow]\nkind = 'shear'\nrate = 1.0\n[numerics]\nend_time = 0.0\n" + numerics;
  };
  write_text(directory / "scene.toml", scene("100.0", "degree = 8\ndt = 0.1\n"));
  const vehd::FrozenState solved = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  const auto difference = [&](const std::string& modulus) {
    write_padded_run(directory / "run.h5", scene(modulus, "degree = 12\ntolerance = 1e-3\n"), solved);
    const vehd::FrozenState read = vehd::read_frozen_state({directory / "run.h5", {}}, std::nullopt);
    vehd::CheckProblem problem = vehd::check_problem(read);
    problem.samples = {};
    const vehd::Vector& stored = read.fields.vesicles.front().tension;
    return (vehd::check_fields(problem, {8}).front().tension - stored).norm() / stored.norm();
  };
  BOOST_TEST(difference("100.0") < 1e-5);
  BOOST_TEST(difference("300.0") > 0.1);
}

BOOST_AUTO_TEST_SUITE_END()
