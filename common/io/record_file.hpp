#pragma once

#include <filesystem>
#include <string>

/// Files of results. Each record's JSON is made in one source, which includes record_json.ipp and says
/// TETHER_RECORD(Type).
namespace tether {

/// Throws RunError if the file cannot be written.
template <class T>
void write_record(const std::filesystem::path& file, const T& record);

/// Throws InputError that names the file and the field if it is not as the record's schema says.
template <class T>
T read_record(const std::filesystem::path& file);

template <class T>
std::string json_of(const T& record);

/// from: the file, for messages. Throws InputError as read_record does.
template <class T>
T record_of(const std::string& json, const std::string& from);

/// A JSON schema (draft 2020-12) with all records that the type is made of.
template <class T>
std::string schema_of(const std::string& title);

}  // namespace tether
