// A picture that a front rendered whole, and could not say so before it died or hung.
#include <gtest/gtest.h>

#include <string>

#include "server/cluster/collector.h"
#include "server/cluster/result.h"
#include "tests/cluster/cluster_test.h"
#include "tests/cluster/stored.h"

namespace raytracer::test {
namespace {

class WholePicture : public ClusterTest {
 protected:
  /// Of one grey that no scene here has.
  static Rendering grey(int size_px) {
    Rendering rendering;
    rendering.image = Image(size_px, size_px);
    std::fill(rendering.image.values.begin(), rendering.image.values.end(), 0.25F);
    rendering.pixel_count = rendering.image.values.size() / 3;
    return rendering;
  }
};

TEST_F(WholePicture, of_a_dead_front_is_the_job_that_another_takes_over) {
  start_worker();
  Stored stored(nats().url());
  stored.store.ensure_streams();
  ASSERT_TRUE(eventually([&] { return !stored.renderer().empty(); }));
  JobRecord record = stored.new_job("whole", stored.renderer(), long_scene(60), 350, 0, 0);
  ASSERT_TRUE(stored.store.put_job(record));
  ASSERT_TRUE(stored.store.put_result(record.id, 0, to_bytes({record.front, grey(350)})));
  const ServerProcess& front = start_front({"--task-timeout", "1"});
  ASSERT_TRUE(ends_done(front, "/jobs/whole"));
  WorkerPool pool(1);
  EXPECT_TRUE(get(front, "/jobs/whole/image").body ==
              encode(grey(350).image, ImageFormat::png, pool));
  EXPECT_EQ(stored.store.job("whole")->task_count, 1);
}

TEST_F(WholePicture, among_regions_is_all_of_it) {
  Stored stored(nats().url());
  stored.store.ensure_streams();
  const JobRecord record = stored.new_job("mixed", "build", "", 32, 16, 4);
  RegionRendering<float> region;
  region.region = {16, 0, 32, 16};
  region.values.assign(std::size_t{3} * 16 * 16, 0.5F);
  for (const int whole : {0, 2}) {
    const std::string id = "mixed" + std::to_string(whole);
    JobRecord job = record;
    job.id = id;
    ASSERT_TRUE(stored.store.put_job(job));
    ASSERT_TRUE(stored.store.put_result(id, 1, to_bytes({"worker", region})));
    ASSERT_TRUE(stored.store.put_result(id, whole, to_bytes({"front", grey(32)})));
    Collector collector(stored.store);
    EXPECT_TRUE(collector.collect(job));
    ASSERT_TRUE(collector.is_complete(job));
    const JobResult result = collector.take_result(job);
    const auto& values = std::get<Rendering>(result).image.values;
    EXPECT_EQ(values, grey(32).image.values);
  }
}

}  // namespace
}  // namespace raytracer::test
