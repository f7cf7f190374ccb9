#include "benchmarks/write_settings.h"

#include "benchmarks/field_json.h"

namespace benchmarks {

Json writeSettings(const hair::Settings& settings) { return writeFields(settings); }

}  // namespace benchmarks
