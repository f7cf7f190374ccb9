#include "benchmarks/scene/pattern.h"

#include <re2/re2.h>

#include "engine/error.h"

namespace benchmarks::scene {
namespace {

re2::RE2::Options quietOptions() {
    re2::RE2::Options options;
    options.set_log_errors(false);
    return options;
}

}  // namespace

Pattern::Pattern(const std::string& regex)
    : expression_(std::make_shared<const re2::RE2>(regex, quietOptions())) {
    if (!expression_->ok()) throw engine::Error(expression_->error());
}

bool Pattern::isIn(std::string_view text) const {
    return re2::RE2::PartialMatch({text.data(), text.size()}, *expression_);
}

}  // namespace benchmarks::scene
