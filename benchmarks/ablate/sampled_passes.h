#pragma once

#include <functional>
#include <string>

#include "engine/frame_loop.h"
#include "engine/samples_query.h"

namespace benchmarks {

// Passes of which one's samples are counted. Borrows all.
class SampledPasses : public engine::Passes {
public:
    SampledPasses(engine::Passes& passes, std::string counted, engine::SamplesQuery& query)
        : passes_(passes), counted_(std::move(counted)), query_(query) {
        slot_ = passes.slot();
    }

    void pass(
        const char* name, engine::PassKind kind,
        const std::function<void(engine::Commands&)>& record) override {
        passes_.pass(name, kind, [&](engine::Commands& commands) {
            if (name == counted_) query_.begin(commands);
            record(commands);
            if (name == counted_) query_.end(commands);
        });
    }

private:
    engine::Passes& passes_;
    std::string counted_;
    engine::SamplesQuery& query_;
};

}  // namespace benchmarks
