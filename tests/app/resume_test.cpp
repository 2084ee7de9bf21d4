#include <boost/test/unit_test.hpp>
#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/app/reference_run.hpp"

BOOST_AUTO_TEST_SUITE(resume, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(a_chain_of_fifty_runs_is_one_run) {
  // Each run of the chain takes one step of 0.25; its end is an additional snapshot, so histories are compared.
  constexpr int kLinks = 50;
  const ReferenceRun one(quick_scene("12.5"));
  for (int link = 1; link <= kLinks; ++link) {
    write_text(one.scene, quick_scene(std::to_string(0.25 * link)));
    const ProgramResult result = run_command(one.command);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }
  BOOST_TEST((file_text(one.output + "/history.csv") == file_text(one.reference + "/history.csv")));
  BOOST_TEST(
      (snapshot_data(one.output + "/run.h5").back().second == snapshot_data(one.reference + "/run.h5").back().second));
}

BOOST_AUTO_TEST_CASE(interrupt_leaves_a_resumable_run) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const EndlessRun run;
    RunningProgram program(run.command);
    run.wait_for_rows(program);
    program.send(signal);
    const ProgramResult result = program.wait();
    BOOST_TEST(result.exit_code == 3);
    BOOST_TEST(result.errors.find("continue with: vehd run ") != std::string::npos, result.errors);
    const auto summary = json_of(run.output + "/summary.json");
    BOOST_TEST(!summary.at("completed").get<bool>());
    BOOST_TEST(summary.at("verdict").get<std::string>().starts_with("stopped: a signal came at time "));
    run.finish_soon();
  }
}

// Checking a radial scene starts threads; these must not take the signal either.
BOOST_FIXTURE_TEST_CASE(interrupt_of_a_radial_scene_is_orderly, EndlessRun) {
  std::string text = file_text(scene);
  const std::string shape = "kind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]";
  text.replace(text.find(shape), shape.size(), "kind = \"radial\"\nmodes = [{n = 2, m = 0, a = 0.3}]");
  write_text(scene, text);
  RunningProgram program(command);
  wait_for_rows(program);
  program.send(SIGINT);
  BOOST_TEST(program.wait().exit_code == 3);
}

BOOST_FIXTURE_TEST_CASE(two_runs_in_one_directory_are_refused, EndlessRun) {
  RunningProgram first(command);
  wait_for_rows(first);
  const ProgramResult second = run_command(command);
  BOOST_TEST(second.exit_code == 1);
  BOOST_TEST(second.errors ==
             output + ": another run is writing in this directory; wait for it or choose another -o\n");
  first.send(SIGINT);
  BOOST_TEST(first.wait().exit_code == 3);
  finish_soon();
}

BOOST_FIXTURE_TEST_CASE(complete_run_has_nothing_to_do, ReferenceRun) {
  const std::string history = file_text(reference + "/history.csv");
  const ProgramResult result =
      run_vehd({"run", scene, "-o", reference, "--resume", "--json", directory / "summary.json"});
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.output.find("nothing to do") != std::string::npos);
  BOOST_TEST((file_text(reference + "/history.csv") == history));
  BOOST_TEST(json_of(directory / "summary.json").at("completed").get<bool>());
}

BOOST_FIXTURE_TEST_CASE(a_later_end_continues_the_run, ReferenceRun) {
  write_text(scene, quick_scene("1.0"));
  BOOST_TEST_REQUIRE(run_command(command).exit_code == 0);
  write_text(scene, quick_scene("3.0"));
  finish();
}

BOOST_AUTO_TEST_SUITE_END()
