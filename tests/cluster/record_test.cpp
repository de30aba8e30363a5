// What is stored of jobs and results is read as it was written, and refused if it is damaged.
#include "server/cluster/record.h"

#include <gtest/gtest.h>

#include <string>

#include "server/cluster/nats.h"
#include "server/cluster/result.h"

namespace raytracer::test {
namespace {

JobRecord full_record() {
  return {.id = "abc",
          .task = JobTask::tradeoff,
          .document = "digest",
          .query = {{"samples", "4"}, {"origin", "1,2,3"}},
          .renderer = "build",
          .front = "host-1",
          .has_client = true,
          .is_8_bit = true,
          .picture_digest = "0123",
          .parse_ms = 0.1,
          .queue_ms = 12.5,
          .predicted_ms = 1e300,
          .plan_ms = 0.25,
          .build_ms = 1.5,
          .limits = {.pixels = 1000, .work = 1LL << 62},
          .task_timeout_s = 0.75,
          .width = 640,
          .height = 480,
          .channels = 4,
          .samples = 16,
          .accepted_ms = 1'700'000'000'123,
          .side_px = 48,
          .task_count = 140,
          .failure = "quoted \"text\"\nand \xC3\xA4",
          .lacked_room = true};
}

TEST(JobRecords, are_read_as_they_were_written) {
  const JobRecord record = full_record();
  const JobRecord read = read_record(to_text(record));
  EXPECT_EQ(to_text(read), to_text(record));
  EXPECT_EQ(read.id, record.id);
  EXPECT_EQ(read.task, record.task);
  EXPECT_EQ(read.document, record.document);
  EXPECT_EQ(read.query, record.query);
  EXPECT_EQ(read.renderer, record.renderer);
  EXPECT_EQ(read.front, record.front);
  EXPECT_EQ(read.has_client, record.has_client);
  EXPECT_EQ(read.is_8_bit, record.is_8_bit);
  EXPECT_EQ(read.picture_digest, record.picture_digest);
  EXPECT_EQ(read.parse_ms, record.parse_ms);
  EXPECT_EQ(read.queue_ms, record.queue_ms);
  EXPECT_EQ(read.predicted_ms, record.predicted_ms);
  EXPECT_EQ(read.plan_ms, record.plan_ms);
  EXPECT_EQ(read.build_ms, record.build_ms);
  EXPECT_EQ(read.limits.pixels, record.limits.pixels);
  EXPECT_EQ(read.limits.work, record.limits.work);
  EXPECT_EQ(read.task_timeout_s, record.task_timeout_s);
  EXPECT_EQ(read.width, record.width);
  EXPECT_EQ(read.height, record.height);
  EXPECT_EQ(read.channels, record.channels);
  EXPECT_EQ(read.samples, record.samples);
  EXPECT_EQ(read.accepted_ms, record.accepted_ms);
  EXPECT_EQ(read.side_px, record.side_px);
  EXPECT_EQ(read.task_count, record.task_count);
  EXPECT_EQ(read.failure, record.failure);
  EXPECT_EQ(read.lacked_room, record.lacked_room);
  JobRecord plain = record;
  plain.picture_digest.reset();
  EXPECT_EQ(read_record(to_text(plain)).picture_digest, std::nullopt);
}

TEST(JobRecords, with_a_reason_that_is_no_text_can_be_stored) {
  JobRecord record = full_record();
  record.failure = "a name \xFF of bytes";
  EXPECT_NO_THROW(
      EXPECT_NE(read_record(to_text(record)).failure.find("of bytes"), std::string::npos));
}

TEST(JobRecords, of_builds_that_stored_no_limits_are_read) {
  std::string text = to_text(full_record());
  const std::size_t begin = text.find("\"limits\":{");
  text.erase(begin, text.find("},", begin) + 2 - begin);
  const std::size_t timeout = text.find("\"task_timeout_s\":0.75,");
  ASSERT_NE(timeout, std::string::npos);
  text.erase(timeout, std::string("\"task_timeout_s\":0.75,").size());
  const JobRecord read = read_record(text);
  EXPECT_EQ(read.id, full_record().id);
  EXPECT_EQ(read.limits.pixels, Limits{}.pixels);
  EXPECT_EQ(read.task_timeout_s, JobRecord{}.task_timeout_s);
}

TEST(JobRecords, damaged_ones_are_refused) {
  const std::string text = to_text(full_record());
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_THROW(read_record(text.substr(0, length)), NatsRefused) << length;
  EXPECT_THROW(read_record("[]"), NatsRefused);
  EXPECT_THROW(read_record("{}"), NatsRefused);
}

template <typename Channel>
RegionRendering<Channel> some_region() {
  RegionRendering<Channel> part{.region = {16, 32, 18, 33},
                                .error_multiplier = 1.0 / 3,
                                .precision = Precision::single_precision,
                                .beyond = {.clamped = 5, .not_numbers = 7}};
  part.values = {Channel(1), Channel(2), Channel(3), Channel(4), Channel(5), Channel(6)};
  part.subtile_error2 = {0.1, 1e-300, 3};
  return part;
}

template <typename Channel>
void expect_read_as_written() {
  const RegionRendering<Channel> part = some_region<Channel>();
  const std::string bytes = to_bytes({"worker", part});
  const TaskResult result = read_result(bytes);
  EXPECT_EQ(result.worker, "worker");
  const auto& read = std::get<RegionRendering<Channel>>(result.made);
  EXPECT_EQ(read.region.x_begin, 16);
  EXPECT_EQ(read.region.y_begin, 32);
  EXPECT_EQ(read.region.x_end, 18);
  EXPECT_EQ(read.region.y_end, 33);
  EXPECT_EQ(read.values, part.values);
  EXPECT_EQ(read.subtile_error2, part.subtile_error2);
  EXPECT_EQ(read.error_multiplier, part.error_multiplier);
  EXPECT_EQ(read.precision, part.precision);
  EXPECT_EQ(read.beyond.clamped, 5U);
  EXPECT_EQ(read.beyond.not_numbers, 7U);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(read_result(bytes.substr(0, length)), NatsRefused) << length;
  EXPECT_THROW(read_result(bytes + "x"), NatsRefused);
}

TEST(TaskResults, of_regions_are_read_as_they_were_written) {
  expect_read_as_written<float>();
  expect_read_as_written<unsigned char>();
}

class WholePictures : public testing::TestWithParam<int> {};

TEST_P(WholePictures, are_read_as_they_were_written) {
  Rendering rendering;
  rendering.image = Image(2, 1, GetParam());
  for (std::size_t i = 0; i < rendering.image.values.size(); ++i)
    rendering.image.values[i] = 0.1F * static_cast<float>(i);
  rendering.pixel_count = 2;
  rendering.samples_per_pixel = 12.5;
  rendering.estimated_error = 0.1;
  rendering.precision = Precision::single_precision;
  rendering.beyond = {.clamped = 5, .not_numbers = 7};
  rendering.stop = Stop::budget;
  rendering.plan_ms = 1;
  rendering.build_ms = 2;
  rendering.trace_ms = 3;
  const std::string bytes = to_bytes({"worker", rendering});
  const TaskResult result = read_result(bytes);
  const auto& read = std::get<Rendering>(result.made);
  EXPECT_EQ(read.image.width, 2);
  EXPECT_EQ(read.image.height, 1);
  EXPECT_EQ(read.image.channels, GetParam());
  EXPECT_TRUE(std::equal(read.image.values.begin(), read.image.values.end(),
                         rendering.image.values.begin(), rendering.image.values.end()));
  EXPECT_EQ(read.pixel_count, 2U);
  EXPECT_EQ(read.samples_per_pixel, 12.5);
  EXPECT_EQ(read.estimated_error, 0.1);
  EXPECT_EQ(read.precision, Precision::single_precision);
  EXPECT_EQ(read.beyond.clamped, 5U);
  EXPECT_EQ(read.beyond.not_numbers, 7U);
  EXPECT_EQ(read.stop, Stop::budget);
  EXPECT_EQ(read.plan_ms + read.build_ms + read.trace_ms, 6);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(read_result(bytes.substr(0, length)), NatsRefused) << length;
  EXPECT_THROW(read_result(bytes + "x"), NatsRefused);
}

INSTANTIATE_TEST_SUITE_P(OfChannels, WholePictures, testing::Values(3, 4));

TEST(TaskResults, of_curves_are_read_as_they_were_written) {
  const TaskResult result = read_result(to_bytes({"worker", CurveText{"{\n}"}}));
  EXPECT_EQ(std::get<CurveText>(result.made).json, "{\n}");
}

TEST(TaskResults, that_claim_impossible_sizes_are_refused) {
  const std::string region =
      R"("region":[0,0,16,16],"error_multiplier":1,"precision":0,"light_samples":1,)"
      R"("beyond":[0,0],"worker":"w")";
  const std::string whole =
      R"("kind":"whole","samples":1,"precision":0,"light_samples":1,"beyond":[0,0],"stop":0,)"
      R"("plan_ms":0,"build_ms":0,"trace_ms":0,"worker":"w")";
  EXPECT_NO_THROW(read_result(R"({"kind":"floats","values":0,"errors":0,)" + region + "}\n"));
  EXPECT_NO_THROW(read_result(R"({"width":0,"height":0,"channels":3,)" + whole + "}\n"));
  for (const std::string& header :
       {R"({"kind":"floats","values":4611686018427387904,"errors":0,)" + region + "}",
        R"({"kind":"bytes","values":-1,"errors":0,)" + region + "}",
        R"({"width":-1,"height":1,"channels":3,)" + whole + "}",
        R"({"width":1000000000,"height":1000000000,"channels":3,)" + whole + "}",
        R"({"width":0,"height":0,"channels":2,)" + whole + "}"}) {
    try {
      read_result(header + "\n");
      ADD_FAILURE() << "it is read: " << header;
    } catch (const NatsRefused& error) {
      EXPECT_STREQ(error.what(), "a task's result is not as long as it says") << header;
    }
  }
}

TEST(TaskResults, that_are_none_are_refused) {
  for (const char* const header : {R"({"kind":"nonsense","worker":"w"})", "[]", "{"})
    EXPECT_THROW(read_result(std::string(header) + "\n"), NatsRefused) << header;
}

}  // namespace
}  // namespace raytracer::test
