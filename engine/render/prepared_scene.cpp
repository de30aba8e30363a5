#include "engine/render/prepared_scene.h"

#include <utility>

#include "engine/kernel/this_machine.h"
#include "engine/measure/stopwatch.h"
#include "engine/render/built_scene.h"

namespace raytracer {
namespace {

std::unique_ptr<const BuiltScene> build(const Scene& scene, WorkerPool& pool) {
  const Stopwatch plan_watch;
  PackedScene packed = pack_scene(scene, &pool);
  Plan plan = make_plan(scene, packed, this_machine(pool.thread_count()), &pool);
  const double plan_ms = plan_watch.elapsed_ms();
  const Stopwatch build_watch;
  Tracer tracer = make_tracer(plan, std::move(packed), pool);
  return std::make_unique<const BuiltScene>(
      BuiltScene{scene, std::move(plan), std::move(tracer), plan_ms, build_watch.elapsed_ms()});
}

}  // namespace

PreparedScene::PreparedScene(const Scene& scene, WorkerPool& pool) : built_(build(scene, pool)) {}
PreparedScene::~PreparedScene() = default;
PreparedScene::PreparedScene(PreparedScene&&) noexcept = default;

const Scene& PreparedScene::scene() const { return built_->scene; }
const Plan& PreparedScene::plan() const { return built_->plan; }
double PreparedScene::build_ms() const { return built_->build_ms; }
double PreparedScene::plan_ms() const { return built_->plan_ms; }

}  // namespace raytracer
