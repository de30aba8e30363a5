#include "server/cluster/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "server/cluster/stored_text.h"
#include "server/cluster/subjects.h"
#include "server/digest.h"

namespace raytracer {
namespace {

using std::chrono::milliseconds;

/// Above 31 MB server 2.9.10 loses acknowledged messages in a crash.
constexpr std::size_t most_result_bytes_at_once = 4'000'000;
constexpr std::size_t header_bytes = 1024;

std::string consumer_of(const std::string& renderer, const std::string& id) {
  return renderer + "_" + id;
}

/// The number at a subject's end.
int last_number(const std::string& subject) {
  const std::size_t dot = subject.rfind('.');
  int number = -1;
  std::from_chars(subject.data() + dot + 1, subject.data() + subject.size(), number);
  return number;
}

std::string random_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

/// In the first line of a text in chunks, how many they are.
std::string in_parts(std::size_t count) { return fmt::format("parts {}", count); }

}  // namespace

std::string ClusterStore::digest_of(std::string_view document) {
  return sha256_hex(document).substr(0, 32);
}

StoredText ClusterStore::document_at(const std::string& digest) const {
  return {nats_, stream::scenes, subject::scene, digest};
}

StoredText ClusterStore::kept_at(const std::string& id) const {
  return {nats_, stream::kept, subject::kept, id};
}

void ClusterStore::put_document(const std::string& digest, std::string_view document) {
  const StoredText text = document_at(digest);
  if (text.is_stored(document, limits_.longest_kept / 2)) return;
  try {
    text.put(document);
  } catch (const StreamFull&) {
    remove_unused_documents();
    text.put(document);
  }
}

void ClusterStore::remove_unused_documents() {
  // What comes after this list stays, and so does what a job of the last moment uses.
  const std::set<std::string> candidates = StoredText::names(nats_, stream::scenes, subject::scene);
  std::set<std::string> looked_at;
  std::set<std::string> used;
  const auto look = [&] {
    for (const std::string& id : job_ids()) {
      if (!looked_at.insert(id).second) continue;
      const auto record = job(id);
      if (record && !used.contains(record->document) && is_open(*record))
        used.insert(record->document);
    }
  };
  try {
    look();
    look();
  } catch (const UnreadableRecord&) {
    return;  // of another build: who knows what it needs
  }
  for (const std::string& digest : candidates)
    if (!used.contains(digest)) document_at(digest).remove();
}

std::string ClusterStore::document(const std::string& digest) {
  std::optional<std::string> text = document_at(digest).get();
  if (text && digest_of(*text) == digest) return *std::move(text);
  throw NatsRefused(fmt::format(
      "the scene {} is no longer stored: others needed the memory (--max-stored)", digest));
}

void ClusterStore::keep_scene(const std::string& id, std::string_view document) {
  if (2 * static_cast<std::int64_t>(document.size()) > most_kept_bytes()) return;  // for all others
  // Texts of one id may differ in white space: of two that came at a time, parts may be mixed.
  const StoredText text = kept_at(id);
  if (text.is_stored(document, limits_.longest_kept / 2) && text.get() == document) return;
  text.put(document);
}

std::optional<std::string> ClusterStore::kept_scene(const std::string& id) {
  return kept_at(id).get();
}

bool ClusterStore::is_open(const JobRecord& record) {
  if (!record.failure.empty()) return false;
  return record.task_count == 0 ||
         results(record.id).size() < static_cast<std::size_t>(record.task_count);
}

bool ClusterStore::put_job(JobRecord& record) {
  const auto sequence = nats_.replace(subject::record(record.id), to_text(record), record.sequence);
  if (!sequence) return false;
  record.sequence = *sequence;
  nats_.signal(subject::news_of_tasks, record.id);
  return true;
}

void ClusterStore::fail_job(const std::string& id, const std::string& reason, bool lacked_room) {
  std::optional<JobRecord> record = job(id);
  if (!record || !record->failure.empty()) return remove_results(id);
  record->failure = reason;
  record->lacked_room = lacked_room;
  if (!put_job(*record)) return;
  close_job(*record);
  remove_results(id);
}

std::optional<JobRecord> ClusterStore::job(const std::string& id) {
  const auto found = nats_.get(stream::jobs, subject::record(id));
  if (!found) return {};
  JobRecord record = read_record(found->data);
  record.sequence = found->sequence;
  record.stored_ms = found->time_ms;
  return record;
}

std::vector<std::string> ClusterStore::job_ids() {
  std::vector<std::string> ids = nats_.subjects(stream::jobs, subject::record(subject::any));
  for (std::string& id : ids) id.erase(0, id.rfind('.') + 1);
  return ids;
}

void ClusterStore::remove_job(const std::string& id) {
  const auto record = job(id);
  nats_.purge(stream::jobs, subject::record(id));
  nats_.signal(subject::removals, id);
  if (record) remove_rest(id, record->renderer);
}

void ClusterStore::remove_rest(const std::string& id, const std::string& renderer) {
  nats_.purge(stream::tasks, subject::task(id, subject::any));
  nats_.purge(stream::jobs, subject::about_tasks(id));
  nats_.purge(stream::jobs, subject::progress(id));
  remove_results(id);
  nats_.remove_consumer(stream::tasks, consumer_of(renderer, id));
}

void ClusterStore::remove_results(const std::string& id) {
  nats_.purge(stream::results, subject::results(id));
}

void ClusterStore::close_job(const JobRecord& record) {
  nats_.purge(stream::tasks, subject::task(record.id, subject::any));
  nats_.remove_consumer(stream::tasks, consumer_of(record.renderer, record.id));
}

void ClusterStore::queue_tasks(const JobRecord& record, const std::vector<int>& tasks) {
  nats_.ensure_consumer(stream::tasks, {.name = consumer_of(record.renderer, record.id),
                                        .subjects = subject::task(record.id, subject::any),
                                        .description = record.document,
                                        .time_to_acknowledge = record.task_timeout(),
                                        .longest_idle = limits_.longest_kept});
  std::vector<std::string> subjects;
  subjects.reserve(tasks.size());
  for (const int task : tasks) subjects.push_back(subject::task(record.id, task));
  nats_.create_all(subjects);
  nats_.signal(subject::news_of_tasks, record.id);
}

std::vector<OpenJob> ClusterStore::open_jobs() {
  std::vector<OpenJob> jobs;
  for (const ConsumerFill& consumer : nats_.consumers(stream::tasks)) {
    const std::size_t end = consumer.name.find('_');
    if (end == consumer.name.npos) continue;
    jobs.push_back({consumer.name.substr(end + 1), consumer.name.substr(0, end),
                    consumer.description, consumer.waiting, consumer.running});
  }
  return jobs;
}

std::size_t ClusterStore::open_job_count() { return nats_.consumer_names(stream::tasks).size(); }

TaskSource ClusterStore::tasks_of(const OpenJob& job) {
  return nats_.source(stream::tasks, consumer_of(job.renderer, job.id));
}

std::pair<std::string, int> ClusterStore::task_of(const std::string& subject) {
  constexpr std::size_t begin = subject::of_tasks.size();
  const std::size_t dot = subject.rfind('.');
  return {subject.substr(begin, dot - begin), last_number(subject)};
}

bool ClusterStore::put_result(const std::string& id, int task, std::string_view bytes) {
  const std::string subject = subject::result(id, task);
  bool is_first = false;
  if (bytes.size() + header_bytes <=
      std::min(nats_.most_message_bytes(), most_result_bytes_at_once)) {
    is_first = nats_.replace(subject, bytes, 0).has_value();
  } else {
    // Two who work on the same task must not mix their parts.
    const std::string token = random_token();
    const std::size_t count = chunks_in(bytes.size());
    for (std::size_t i = 0; i < count; ++i)
      nats_.put(subject::result_part(id, token, i), chunk(bytes, i));
    is_first = nats_.replace(subject, fmt::format("{} {}", in_parts(count), token), 0).has_value();
    if (!is_first) nats_.purge(stream::results, subject::result_part(id, token, subject::any));
  }
  // Who removed the job meanwhile, or failed it, may have looked for its results before this came.
  if (!is_wanted(id)) {
    remove_results(id);
    return false;
  }
  nats_.signal(subject::news_of_results, id);
  return is_first;
}

bool ClusterStore::is_wanted(const std::string& id) {
  try {
    const auto record = job(id);
    return record && record->failure.empty();
  } catch (const UnreadableRecord&) {
    return true;  // by those who can read it
  }
}

bool ClusterStore::has_result(const std::string& id, int task) {
  return !nats_.subjects(stream::results, subject::result(id, task)).empty();
}

std::set<int> ClusterStore::results(const std::string& id) {
  std::set<int> tasks;
  for (const std::string& subject :
       nats_.subjects(stream::results, subject::result(id, subject::any)))
    tasks.insert(last_number(subject));
  return tasks;
}

std::optional<StoredMessage> ClusterStore::result(const std::string& id, int task) {
  auto found = nats_.get(stream::results, subject::result(id, task));
  if (!found || !found->data.starts_with("parts ")) return found;
  const std::size_t space = found->data.rfind(' ');
  const std::string token = found->data.substr(space + 1);
  std::size_t count = 0;
  std::from_chars(found->data.data() + std::string_view("parts ").size(),
                  found->data.data() + space, count);
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = nats_.get(stream::results, subject::result_part(id, token, i));
    if (!part) return {};
    bytes += part->data;
  }
  found->data = std::move(bytes);
  return found;
}

StreamFill ClusterStore::fill_of_results() { return nats_.fill_of(stream::results); }

void ClusterStore::note_hand_back(const std::string& id, int task, std::uint64_t delivery) {
  nats_.put(subject::hand_back(id, task, delivery), "");
}

std::size_t ClusterStore::hand_backs(const std::string& id, int task) {
  return nats_.subjects(stream::jobs, subject::hand_back(id, task, subject::any)).size();
}

void ClusterStore::put_progress(const std::string& id, double fraction) {
  nats_.put(subject::progress(id), fmt::format("{}", fraction));
}

double ClusterStore::progress(const std::string& id) {
  const auto found = nats_.get(stream::jobs, subject::progress(id));
  return found ? std::strtod(found->data.c_str(), nullptr) : 0;
}

std::vector<TaskFailure> ClusterStore::failures(const std::string& id, int task) {
  std::vector<TaskFailure> failures;
  for (const std::string& subject :
       nats_.subjects(stream::jobs, subject::failure(id, task, subject::any)))
    if (const auto found = nats_.get(stream::jobs, subject)) {
      const std::size_t line = found->data.find('\n');
      failures.push_back({found->data.substr(0, line), found->data.substr(line + 1)});
    }
  return failures;
}

void ClusterStore::add_failure(const std::string& id, int task, std::size_t number,
                               const TaskFailure& failure) {
  nats_.put(subject::failure(id, task, number), failure.worker + '\n' + failure.reason);
}

void ClusterStore::put_member(const Member& member) {
  const nlohmann::json json{{"name", member.name},
                            {"build", member.build},
                            {"instruction_set", member.instruction_set},
                            {"renderer", member.renderer},
                            {"threads", member.threads},
                            {"tasks_done", member.tasks_done},
                            {"works", member.works}};
  nats_.put(subject::worker(member.name), json.dump());
}

void ClusterStore::remove_member(const std::string& name) {
  nats_.purge(stream::workers, subject::worker(name));
}

std::vector<Member> ClusterStore::members() {
  std::vector<Member> members;
  for (const std::string& subject :
       nats_.subjects(stream::workers, subject::worker(subject::any))) {
    const auto found = nats_.get(stream::workers, subject);
    if (!found) continue;
    const auto json = nlohmann::json::parse(found->data, nullptr, false);
    if (json.is_discarded()) continue;
    members.push_back(
        {json.value("name", ""), json.value("build", ""), json.value("instruction_set", ""),
         json.value("renderer", ""), json.value("threads", std::size_t{0}),
         json.value("tasks_done", std::uint64_t{0}), json.value("works", false), found->time_ms});
  }
  // By one clock: those of two machines may differ. Whoever asks has a heartbeat, too.
  std::int64_t latest_ms = 0;
  for (const Member& member : members) latest_ms = std::max(latest_ms, member.heard_ms);
  for (Member& member : members)
    member.silence_s = static_cast<double>(latest_ms - member.heard_ms) / 1000;
  return members;
}

void ClusterStore::note_redelivery(const std::string& id, int task) {
  nats_.put(subject::redelivered(id, task), "");
}

std::uint64_t ClusterStore::redelivered() {
  return nats_.fill_of(stream::redelivered).messages_ever;
}

std::shared_ptr<const void> ClusterStore::listen_for_news(std::function<void()> heard,
                                                          bool with_results) {
  return nats_.listen(with_results ? subject::news : subject::news_of_tasks,
                      [heard = std::move(heard)](const auto&, const auto&) { heard(); });
}

std::shared_ptr<const void> ClusterStore::listen_for_removals(
    std::function<void(const std::string& id)> heard) {
  return nats_.listen(subject::removals,
                      [heard = std::move(heard)](const auto&, const auto& id) { heard(id); });
}

}  // namespace raytracer
