// /schema/scene.json and the engine's reader agree: what one refuses, so does the other, but for
// the rules that JSON Schema cannot express. The schema's verdicts are valijson's.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "engine/engine.h"
#include "tests/process/temporary_folder.h"
#include "tests/service/schema_documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

/// The schema as the server gives it out.
class Schema : public Service {
 protected:
  Schema() : json_(json_of(get("/schema/scene.json"))) {
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(json_), schema_);
  }

  /// What is wrong by the schema; empty if nothing is.
  std::string refusal(const nlohmann::json& document) const {
    valijson::Validator validator;
    valijson::ValidationResults results;
    valijson::adapters::NlohmannJsonAdapter adapter(document);
    if (validator.validate(schema_, adapter, &results)) return {};
    valijson::ValidationResults::Error error;
    std::string text = "invalid:";
    while (results.popError(error)) text += " " + error.description;
    return text;
  }

  const nlohmann::json json_;

 private:
  valijson::Schema schema_;
};

bool engine_accepts(const nlohmann::json& document) {
  return read_scene(document.dump(), Limits{}).ok();
}

std::string name_of(const Change& change) {
  return change.pointer + (change.removes ? " missing" : " = " + change.value.dump());
}

TEST_F(Schema, every_shipped_scene_is_valid) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(RAYTRACER_SOURCE_DIR "/server/scenes")) {
    const nlohmann::json document = nlohmann::json::parse(read_file(entry.path()));
    EXPECT_EQ(refusal(document), "") << entry.path();
    EXPECT_EQ(document.value("$schema", ""), "/schema/scene.json") << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST_F(Schema, right_documents_are_valid_to_schema_and_engine) {
  EXPECT_EQ(refusal(full_scene), "");
  EXPECT_TRUE(engine_accepts(full_scene));
  for (const Change& change : right_changes) {
    const nlohmann::json document = changed(change);
    EXPECT_EQ(refusal(document), "") << name_of(change);
    EXPECT_TRUE(engine_accepts(document)) << name_of(change);
  }
}

TEST_F(Schema, wrong_documents_are_invalid_to_schema_and_engine) {
  for (const Change& change : wrong_changes) {
    const nlohmann::json document = changed(change);
    EXPECT_NE(refusal(document), "") << name_of(change);
    EXPECT_FALSE(engine_accepts(document)) << name_of(change);
  }
}

TEST_F(Schema, what_no_schema_can_say_the_engine_says) {
  for (const Change& change : wrong_beyond_schema) {
    const nlohmann::json document = changed(change);
    EXPECT_EQ(refusal(document), "") << name_of(change) << ": move it to wrong_changes";
    EXPECT_FALSE(engine_accepts(document)) << name_of(change);
  }
}

/// All defaults of a property of that name, wherever the schema has it.
void add_defaults(const nlohmann::json& schema, const std::string& name,
                  std::set<nlohmann::json>& found) {
  if (!schema.is_structured()) return;
  if (schema.is_object() && schema.contains("properties")) {
    const nlohmann::json& property = schema["properties"].value(name, nlohmann::json::object());
    if (property.contains("default")) found.insert(property["default"]);
  }
  for (const nlohmann::json& part : schema) add_defaults(part, name, found);
}

TEST_F(Schema, pages_form_shows_the_same_defaults) {
  const std::string script = get("/form_controls.js").body;
  std::smatch table;
  ASSERT_TRUE(std::regex_search(script, table, std::regex(R"(const defaults = (\{.*\});)")));
  const nlohmann::json in_page =
      nlohmann::json::parse(std::regex_replace(table[1].str(), std::regex(R"((\w+):)"), "\"$1\":"));
  for (const auto& [name, value] : in_page.items()) {
    std::set<nlohmann::json> found;
    add_defaults(json_, name, found);
    EXPECT_EQ(found, std::set<nlohmann::json>{value}) << name;
  }
}

}  // namespace
}  // namespace raytracer::test
