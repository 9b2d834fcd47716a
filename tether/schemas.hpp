#pragma once

#include <string>
#include <vector>

namespace tether {

/// The JSON schema of a file of results (docs/schema).
struct ResultSchema {
  const char* file;  ///< "diagnosis.json"
  std::string (*text)();
};
const std::vector<ResultSchema>& result_schemas();

/// tether schema [FILE]: prints the schema of a file of results, or the names of all.
int print_schema(int argc, char** argv);

}  // namespace tether
