#include "bie/support/ranks/ranks.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "bie/support/errors.hpp"
#include "bie/support/ranks/partition.hpp"
#include "tests/support/forked_ranks.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(ranks)

namespace {

/// Checks that all ranks return this text.
void check_all_say(const std::vector<std::string>& said, const std::string& expected) {
  for (const std::string& of_rank : said) BOOST_TEST(of_rank == expected);
}

std::vector<int> owners(const std::vector<double>& costs, int n_ranks) {
  const std::string said = on_ranks(n_ranks, [&](const Ranks& ranks) {
                             const Partition partition(ranks, costs);
                             std::vector<int> all;
                             for (std::size_t a = 0; a < costs.size(); ++a) all.push_back(partition.owner(a));
                             return packed(all);
                           }).front();
  return unpacked<std::vector<int>>(said);
}

struct Parts {
  Matrix matrix;
  Vector vector;
  double number = 0.0;
};

template <MaybeConst<Parts> Sent, typename Visit>
void visit_members(Sent& parts, Visit& visit) {
  visit(parts.matrix, parts.vector, parts.number);
}

}  // namespace

BOOST_AUTO_TEST_CASE(values_come_out_as_they_were_put_in) {
  const std::vector<Parts> sent{{Matrix::Random(3, 2), Vector(), 1.5}, {Matrix(), Vector::Random(4), -2.0}};
  const auto received = unpacked<std::vector<Parts>>(packed(sent));
  BOOST_TEST(received.size() == 2U);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    BOOST_TEST((received[i].matrix == sent[i].matrix));
    BOOST_TEST((received[i].vector == sent[i].vector));
    BOOST_TEST(received[i].number == sent[i].number);
  }
  const std::map<std::string, int> counts{{"", 1}, {"b", 2}};
  BOOST_TEST((unpacked<std::map<std::string, int>>(packed(counts)) == counts));
  BOOST_CHECK_THROW((void)unpacked<double>(packed(true)), std::logic_error);
}

BOOST_AUTO_TEST_CASE(costs_are_shared_in_the_order_of_the_parts) {
  BOOST_TEST((owners({1, 1, 1, 1}, 2) == std::vector{0, 0, 1, 1}));
  BOOST_TEST((owners({3, 1, 1, 1}, 2) == std::vector{0, 1, 1, 1}));
  BOOST_TEST((owners({1, 1}, 3) == std::vector{0, 2}));
}

BOOST_AUTO_TEST_CASE(every_rank_gets_the_values_of_all_parts) {
  for (const int n_ranks : {1, 2, 3}) {
    const auto said = on_ranks(n_ranks, [](const Ranks& ranks) {
      const Partition partition(ranks, {1.0, 1.0, 1.0, 1.0, 1.0});
      const auto values = partition.of_all(
          5, [](std::size_t a) { return Vector(Vector::Constant(2, 0.1 * double(a))); },
          [](const Vector& of_original, std::size_t) { return of_original; });
      std::string text;
      for (const Vector& value : values) text += fmt::format("{} ", value.sum());
      return text;
    });
    check_all_say(said, "0 0.2 0.4 0.6000000000000001 0.8 ");
  }
}

BOOST_AUTO_TEST_CASE(images_follow_from_their_originals_on_every_rank) {
  for (const int n_ranks : {1, 2, 3}) {
    const auto said = on_ranks(n_ranks, [](const Ranks& ranks) {
      const Partition partition(ranks, std::vector<double>(6, 1.0), {0, 1, 1, 0, 4, 4});
      std::string text;
      for (std::size_t a = 0; a < 6; ++a) {
        if (partition.is_image(a)) text += partition.is_local(a) ? "done " : fmt::format("{} ", a);
      }
      std::vector<double> done(6);
      for (const std::size_t a : partition.local_indices(6)) done[a] = 0.5 * static_cast<double>(a);
      partition.gather(done, [](double of_original, std::size_t a) { return of_original + static_cast<double>(a); });
      for (const double value : done) text += fmt::format("{} ", value);
      return text;
    });
    check_all_say(said, "2 3 5 0 0.5 2.5 3 2 7 ");
  }
}

BOOST_AUTO_TEST_CASE(texts_go_to_the_ranks_they_are_for) {
  const auto said = on_ranks(3, [](const Ranks& ranks) {
    std::vector<std::string> to;
    for (int other = 0; other < 3; ++other) to.push_back(fmt::format("{}{} ", ranks.rank(), other));
    std::string text;
    for (const std::string& received : ranks.exchange(to)) text += received;
    return text;
  });
  BOOST_TEST((said == std::vector<std::string>{"00 10 20 ", "01 11 21 ", "02 12 22 "}));
}

BOOST_AUTO_TEST_CASE(an_exception_of_one_rank_is_thrown_by_all) {
  // The other ranks meanwhile do nothing, make a call, or make a call within another.
  for (const int busy : {0, 1, 2}) {
    const auto said = on_ranks(3, [&](const Ranks& ranks) -> std::string {
      try {
        ranks.collective([&] {
          if (ranks.rank() == 1) throw ConvergenceError("no step");
          if (busy == 1) (void)ranks.any(false);
          if (busy == 2) ranks.collective([&] { ranks.meet(); });
        });
      } catch (const ConvergenceError& error) {
        // All ranks continue together.
        return fmt::format("{} {}", error.what(), ranks.any(ranks.rank() == 2));
      }
      return "nothing";
    });
    check_all_say(said, "no step true");
  }
}

BOOST_AUTO_TEST_CASE(of_several_failures_the_lowest_rank_is_heard) {
  const auto said = on_ranks(3, [](const Ranks& ranks) -> std::string {
    ranks.collective([&] {
      if (ranks.rank() > 0) throw InputError(fmt::format("rank {}", ranks.rank()));
    });
    return "nothing";
  });
  check_all_say(said, "rank 1");
}

BOOST_AUTO_TEST_CASE(ranks_that_do_different_things_are_reported) {
  const auto said = on_ranks(2, [](const Ranks& ranks) -> std::string {
    if (ranks.is_first()) {
      (void)ranks.any(false);
    } else {
      ranks.meet();
    }
    return "nothing";
  });
  check_all_say(said, "the ranks have taken different decisions; accepted: processors of one kind, which round alike");
}

BOOST_AUTO_TEST_SUITE_END()
