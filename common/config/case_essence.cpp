#include "common/config/case_essence.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/base/checked_file.hpp"

namespace tether {
namespace {

using Json = nlohmann::json;

/// Folders of files do not count: a case may be moved.
void forget_folders(Json& value) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with('/'))
    value = std::filesystem::path(value.get<std::string>()).filename().string();
  else if (value.is_structured())
    for (auto& item : value) forget_folders(item);
}

std::string essence(const std::string& effective_case) {
  Json json = Json::parse(effective_case, nullptr, false);
  if (json.is_discarded()) return effective_case;  // an external code's own format
  if (json.is_object()) {
    for (const char* name : {"output", "coupling", "title"}) json.erase(name);
    if (json.contains("time") && json["time"].is_object()) json["time"].erase("end");
  }
  forget_folders(json);
  return json.dump();
}

}  // namespace

std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed) {
  const std::string text = essence(effective_case);
  return hash_bytes(text.data(), text.size(), seed);
}

}  // namespace tether
