#include "bie/runs/sweep/claim.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <thread>

#include "bie/runs/sweep/heartbeat.hpp"
#include "bie/support/interruption.hpp"
#include "tests/support/files.hpp"
#include "tests/support/waiting.hpp"

BOOST_AUTO_TEST_SUITE(claims)

namespace {

namespace fs = std::filesystem;
using Kind = vehd::ClaimState::Kind;

struct RunsFolder {
  TemporaryDirectory directory;
  fs::path runs = directory / "runs";
  fs::path run = runs / "a";
};

/// A process that waits until it is killed.
pid_t waiting_process() {
  const pid_t process = ::fork();
  if (process == 0) {
    ::pause();
    ::_exit(0);
  }
  return process;
}

vehd::WorkerId worker_with(pid_t process) {
  vehd::WorkerId worker = vehd::this_worker();
  std::string text = file_text("/proc/" + std::to_string(process) + "/stat");
  std::istringstream rest(text.substr(text.rfind(')') + 1));
  std::string word;
  for (int i = 0; i < 20; ++i) rest >> word;
  worker.process = process;
  worker.start = std::stoull(word);
  return worker;
}

void claim_for(const RunsFolder& folder, const vehd::WorkerId& worker, int takeovers = 0) {
  fs::create_directories(folder.run);
  write_text(folder.run / ("claim.held@" + text_of(worker) + "@" + std::to_string(takeovers)), "");
}

/// Moves the time of the claim back.
void age_claim(const fs::path& run, int seconds) {
  const fs::path claim = run / vehd::claim_state(run).name;
  fs::last_write_time(claim, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_run_belongs_to_the_first_that_claims_it, RunsFolder) {
  const vehd::Claims claims(runs);
  BOOST_TEST(static_cast<int>(vehd::claim_state(run).kind) == static_cast<int>(Kind::absent));
  const auto claim = claims.take("a");
  BOOST_TEST_REQUIRE(claim.has_value());
  BOOST_TEST(vehd::claim_state(run).worker.process == ::getpid());
  BOOST_TEST(!claims.take("a"));
  claim->release();
  const auto again = claims.take("a");
  BOOST_TEST_REQUIRE(again.has_value());
  again->finish();
  BOOST_TEST(!claims.take("a"));
  BOOST_TEST(static_cast<int>(vehd::claim_state(run).kind) == static_cast<int>(Kind::done));
}

BOOST_FIXTURE_TEST_CASE(of_many_that_claim_at_once_one_succeeds, RunsFolder) {
  constexpr int n_runs = 50, n_workers = 4;
  std::vector<pid_t> workers;
  for (int w = 0; w < n_workers; ++w) {
    const pid_t worker = ::fork();
    if (worker > 0) {
      workers.push_back(worker);
      continue;
    }
    const vehd::Claims claims(runs);
    for (int i = 0; i < n_runs; ++i) {
      const auto claim = claims.take("run" + std::to_string(i));
      if (claim) write_text(claim->directory() / ("won_by_" + std::to_string(w)), "");
    }
    ::pause();
    ::_exit(0);
  }
  const auto wins = [&] {
    int count = 0;
    for (int i = 0; i < n_runs; ++i) {
      for (int w = 0; w < n_workers; ++w) {
        count += fs::exists(runs / ("run" + std::to_string(i)) / ("won_by_" + std::to_string(w))) ? 1 : 0;
      }
    }
    return count;
  };
  BOOST_TEST(comes_true([&] { return wins() >= n_runs; }, std::chrono::seconds(60)));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  BOOST_TEST(wins() == n_runs);
  for (const pid_t worker : workers) {
    ::kill(worker, SIGKILL);
    ::waitpid(worker, nullptr, 0);
  }
}

BOOST_FIXTURE_TEST_CASE(the_claim_of_a_process_that_has_ended_is_taken_over, RunsFolder) {
  const pid_t process = waiting_process();
  claim_for(*this, worker_with(process));
  const vehd::Claims claims(runs);
  age_claim(run, 100000);
  BOOST_TEST(!claims.take("a"));
  ::kill(process, SIGKILL);
  // Nobody has waited for it yet: it is there as a zombie.
  BOOST_TEST(comes_true([&] { return !vehd::lives(worker_with(process)); }, std::chrono::seconds(60)));
  const auto claim = claims.take("a");
  BOOST_TEST(claim.has_value());
  ::waitpid(process, nullptr, 0);
  BOOST_TEST(vehd::claim_state(run).takeovers == 1);
}

BOOST_FIXTURE_TEST_CASE(a_process_number_that_came_again_is_another_process, RunsFolder) {
  vehd::WorkerId worker = vehd::this_worker();
  worker.start -= 1;
  claim_for(*this, worker);
  BOOST_TEST(vehd::Claims(runs).take("a").has_value());
}

BOOST_FIXTURE_TEST_CASE(on_another_machine_the_time_of_the_claim_decides, RunsFolder) {
  vehd::WorkerId worker = vehd::this_worker();
  worker.host = "elsewhere";
  claim_for(*this, worker);
  const vehd::Claims claims(runs);
  BOOST_TEST(!claims.take("a"));
  age_claim(run, 299);
  BOOST_TEST(!claims.take("a"));
  age_claim(run, 310);
  BOOST_TEST(claims.take("a").has_value());
  // Under its new name the claim is young.
  BOOST_TEST(!vehd::Claims(runs, {std::chrono::seconds(20), std::chrono::seconds(30)}).take("a"));
}

BOOST_FIXTURE_TEST_CASE(a_run_that_has_ended_one_worker_after_the_other_counts_as_crashed, RunsFolder) {
  vehd::WorkerId worker = vehd::this_worker();
  worker.start -= 1;
  claim_for(*this, worker, vehd::Claims::most_takeovers);
  BOOST_TEST(!vehd::Claims(runs).take("a"));
  BOOST_TEST(vehd::claim_state(run).signal == SIGKILL);
}

BOOST_FIXTURE_TEST_CASE(a_worker_learns_that_its_claim_is_gone, RunsFolder) {
  vehd::Interruption interruption;
  const vehd::Claims claims(runs);
  const auto claim = claims.take("a");
  age_claim(run, 1000);
  vehd::Heartbeat heartbeat(std::chrono::milliseconds(10));
  heartbeat.watch(claim->file());
  const auto is_young = [&] {
    return fs::file_time_type::clock::now() - fs::last_write_time(claim->file()) < std::chrono::seconds(500);
  };
  BOOST_TEST(comes_true(is_young, std::chrono::seconds(60)));
  BOOST_TEST(!heartbeat.lost());
  BOOST_TEST(!interruption.requested());
  fs::rename(claim->file(), run / "claim.free");
  BOOST_TEST(comes_true([&] { return interruption.requested(); }, std::chrono::seconds(60)));
  BOOST_TEST(heartbeat.lost());
}

BOOST_FIXTURE_TEST_CASE(what_a_killed_worker_has_not_put_into_place_is_tidied_away, RunsFolder) {
  vehd::WorkerId dead = vehd::this_worker();
  dead.start -= 1;
  fs::create_directories(runs / (".b." + text_of(dead)));
  fs::create_directories(runs / (".c." + text_of(vehd::this_worker())));
  vehd::Claims(runs).tidy();
  BOOST_TEST(!fs::exists(runs / (".b." + text_of(dead))));
  BOOST_TEST(fs::exists(runs / (".c." + text_of(vehd::this_worker()))));
}

BOOST_AUTO_TEST_CASE(a_worker_keeps_its_name) {
  const vehd::WorkerId me = vehd::this_worker();
  BOOST_TEST((vehd::worker_of(text_of(me)) == me));
  BOOST_TEST(vehd::is_in_sight(me));
  BOOST_TEST(vehd::lives(me));
  BOOST_TEST(!vehd::worker_of("somebody"));
}

BOOST_AUTO_TEST_SUITE_END()
