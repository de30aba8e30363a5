// The quota for what all requests share: taken piece by piece, given back as a whole, then 429.
#include "server/quota.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/problem.h"

namespace raytracer::test {
namespace {

class QuotaOfTen : public testing::Test {
 protected:
  Quota quota_{10, "full", [] { return 7L; }};
};

TEST_F(QuotaOfTen, share_grows_and_is_given_back_as_a_whole) {
  Quota::Share share = quota_.take(2);
  share->add(3);
  EXPECT_EQ(quota_.taken(), 5);
  const Quota::Share also = share;
  share.reset();
  EXPECT_EQ(quota_.taken(), 5) << "somebody holds it";
}

TEST_F(QuotaOfTen, nothing_taken_leaves_all_to_others) {
  const Quota::Share idle = quota_.take(0);
  EXPECT_NO_THROW(quota_.take(10));
  EXPECT_EQ(quota_.taken(), 0);
}

TEST_F(QuotaOfTen, refusal_says_when_to_try_again_and_takes_nothing) {
  const Quota::Share share = quota_.take(9);
  std::optional<Problem> refusal;
  try {
    share->add(2);
  } catch (const HttpError& error) {
    refusal = error.problem();
  }
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->status, 429);
  EXPECT_EQ(refusal->detail, "full");
  const std::vector<std::pair<std::string, std::string>> expected{{"Retry-After", "7"}};
  EXPECT_EQ(refusal->headers, expected);
  EXPECT_EQ(quota_.taken(), 9);
  EXPECT_NO_THROW(share->add(1));
}

}  // namespace
}  // namespace raytracer::test
