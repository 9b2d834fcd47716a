#include "common/config/case_essence.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/base/checked_file.hpp"
#include "common/config/input_files.hpp"

namespace tether {
namespace {

using Json = nlohmann::json;

/// Files count by what they hold, and their folders do not: a case may be moved.
void look_into_files(Json& value) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with('/')) {
    const std::filesystem::path path = value.get<std::string>();
    value = Json::array({path.filename().string(), hash_content(path)});
  } else if (value.is_structured()) {
    for (auto& item : value) look_into_files(item);
  }
}

std::string essence(const std::string& effective_case) {
  Json json = Json::parse(effective_case, nullptr, false);
  if (json.is_discarded()) return effective_case;  // an external code's own format
  if (json.is_object()) {
    for (const char* name : {"output", "coupling", "title"}) json.erase(name);
    if (json.contains("time") && json["time"].is_object()) json["time"].erase("end");
  }
  look_into_files(json);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed) {
  const std::string text = essence(effective_case);
  return hash_bytes(text.data(), text.size(), seed);
}

}  // namespace tether
