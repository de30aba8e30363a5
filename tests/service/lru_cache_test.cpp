// What is kept of values by their keys, and what goes first.
#include "server/lru_cache.h"

#include <gtest/gtest.h>

#include <memory>

namespace raytracer::test {
namespace {

TEST(LruCaches, to_ask_whether_a_value_is_kept_is_not_to_use_it) {
  LruCache<int> cache(20);
  cache.keep("old", std::make_shared<int>(1), 10);
  cache.keep("new", std::make_shared<int>(2), 10);
  EXPECT_TRUE(cache.contains("old"));
  EXPECT_FALSE(cache.contains("other"));
  EXPECT_EQ(cache.counts().hits + cache.counts().misses, 0U);
  cache.keep("newest", std::make_shared<int>(3), 10);
  EXPECT_FALSE(cache.contains("old"));
  EXPECT_TRUE(cache.contains("new"));
}

TEST(LruCaches, oversized_value_is_forgotten_or_kept_alone) {
  LruCache<int> modest(10);
  modest.keep("small", std::make_shared<int>(1), 4);
  EXPECT_FALSE(modest.keep("large", std::make_shared<int>(2), 11));
  EXPECT_TRUE(modest.contains("small"));

  LruCache<int> generous(10, Oversized::kept_alone);
  generous.keep("small", std::make_shared<int>(1), 4);
  EXPECT_TRUE(generous.keep("large", std::make_shared<int>(2), 11));
  EXPECT_TRUE(generous.contains("large"));
  EXPECT_FALSE(generous.contains("small"));
  EXPECT_TRUE(generous.keep("small", std::make_shared<int>(1), 4));
  EXPECT_FALSE(generous.contains("large"));
  EXPECT_EQ(generous.counts().bytes, 4U);
}

}  // namespace
}  // namespace raytracer::test
