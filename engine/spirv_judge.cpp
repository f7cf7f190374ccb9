#include "engine/spirv_judge.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace engine {
namespace {

using Words = std::span<const std::uint32_t>;

// ---- Allow lists: numbers of the SPIR-V specification 1.6 ---------------------------------------

struct Range {
    std::uint32_t first;
    std::uint32_t last;  // inclusive
};

bool isIn(std::span<const Range> ranges, std::uint32_t number) {
    return std::ranges::any_of(
        ranges, [&](Range range) { return range.first <= number && number <= range.last; });
}

// Instructions, 3.49, without a type and a result.
constexpr std::array kPlain{
    Range{0, 0},  // OpNop
    Range{2, 6},  // OpSourceContinued to OpMemberName
    Range{8, 8},  // OpLine
    Range{10, 10},  // OpExtension
    Range{14, 17},  // OpMemoryModel, OpEntryPoint, OpExecutionMode, OpCapability
    Range{56, 56},  // OpFunctionEnd
    Range{62, 62},  // OpStore
    Range{71, 72},  // OpDecorate, OpMemberDecorate
    Range{246, 247},  // OpLoopMerge, OpSelectionMerge
    Range{249, 251},  // OpBranch, OpBranchConditional, OpSwitch
    Range{253, 255},  // OpReturn, OpReturnValue, OpUnreachable
    Range{317, 317},  // OpNoLine
    Range{330, 331},  // OpModuleProcessed, OpExecutionModeId
};
// Instructions with a result but no type.
constexpr std::array kNames{
    Range{7, 7},  // OpString
    Range{11, 11},  // OpExtInstImport
    Range{19, 24},  // OpTypeVoid to OpTypeMatrix
    Range{28, 28},  // OpTypeArray
    Range{30, 30},  // OpTypeStruct
    Range{32, 33},  // OpTypePointer, OpTypeFunction
    Range{248, 248},  // OpLabel
};
// Instructions with a type and a result.
constexpr std::array kValues{
    Range{1, 1},  // OpUndef
    Range{12, 12},  // OpExtInst
    Range{41, 44},  // OpConstantTrue to OpConstantComposite
    Range{46, 46},  // OpConstantNull
    Range{48, 52},  // OpSpecConstantTrue to OpSpecConstantOp
    Range{54, 55},  // OpFunction, OpFunctionParameter
    Range{57, 57},  // OpFunctionCall
    Range{59, 59},  // OpVariable
    Range{61, 61},  // OpLoad
    Range{65, 66},  // OpAccessChain, OpInBoundsAccessChain
    Range{77, 84},  // vectors, composites, OpTranspose
    Range{109, 112},  // between floats and integers
    Range{124, 124},  // OpBitcast
    Range{126, 152},  // arithmetic
    Range{154, 157},  // OpAny, OpAll, OpIsNan, OpIsInf
    Range{164, 191},  // logic and comparisons
    Range{194, 205},  // bits
    Range{245, 245},  // OpPhi
    Range{400, 400},  // OpCopyLogical
};

// Capabilities, 3.31: only those that glslang declares for the stages themselves. Without inputs
// and outputs, functions can't use what they offer.
constexpr std::array kCapabilities{
    Range{0, 3},  // Matrix, Shader, Geometry, Tessellation
    Range{5283, 5283},  // MeshShadingEXT
};
// Decorations, 3.20.
constexpr std::array kDecorations{
    Range{0, 1},  // RelaxedPrecision, SpecId
    Range{24, 24},  // NonWritable: constant arrays
    Range{42, 42},  // NoContraction
};
// Instructions of GLSL.std.450, without those for doubles and for a fragment's inputs.
constexpr std::array kMathematics{Range{1, 58}, Range{60, 64}, Range{66, 75}, Range{79, 81}};

constexpr std::string_view kMathematicsSet = "GLSL.std.450";
constexpr std::string_view kMeshExtension = "SPV_EXT_mesh_shader";
constexpr std::uint32_t kLogical = 0;  // addressing model, 3.4: pointers are not numbers
constexpr std::uint32_t kFunctionClass = 7;  // storage class, 3.7

namespace op {
constexpr std::uint32_t kLine = 8, kExtension = 10, kExtInstImport = 11, kExtInst = 12,
                        kMemoryModel = 14, kEntryPoint = 15, kCapability = 17, kTypeInt = 21,
                        kTypeFloat = 22, kTypeVector = 23, kTypeMatrix = 24, kTypeArray = 28,
                        kTypeStruct = 30, kTypePointer = 32, kConstant = 43, kSpecConstantOp = 52,
                        kFunctionParameter = 55, kFunctionEnd = 56, kFunctionCall = 57,
                        kVariable = 59, kStore = 62, kAccessChain = 65, kInBoundsAccessChain = 66,
                        kMemberDecorate = 72, kLoopMerge = 246, kSelectionMerge = 247, kLabel = 248,
                        kNoLine = 317;
}  // namespace op

// Names of refused instructions and storage classes in messages.
struct Named {
    Range numbers;
    const char* name;
};
constexpr std::array kInstructionNames{
    Named{{29, 29}, "an array without a size"},
    Named{{25, 27}, "an image"},
    Named{{86, 107}, "an image"},
    Named{{207, 215}, "a derivative such as dFdx()"},
    Named{{218, 221}, "EmitVertex() or EndPrimitive()"},
    Named{{224, 225}, "a barrier"},
    Named{{227, 242}, "an atomic operation"},
    Named{{252, 252}, "'discard'"},  // before SPIR-V 1.6
    Named{{4416, 4416}, "'discard'"},
};
constexpr std::array kClassNames{
    Named{{1, 1}, "a stage's own input such as gl_FragCoord"},
    Named{{3, 3}, "a stage's own output such as gl_Position"},
    Named{{6, 6}, "a variable outside functions"},
};

std::string nameIn(std::span<const Named> names, std::uint32_t number, const char* otherwise) {
    for (const Named& each : names)
        if (each.numbers.first <= number && number <= each.numbers.last) return each.name;
    return otherwise + std::to_string(number);
}

// ---- Bounds of size -----------------------------------------------------------------------------

constexpr std::size_t kHeader = 5;  // words
constexpr std::size_t kMostCode = std::size_t{1} << 18;  // words
// Numbers in a variable. lavapipe takes 4 s longer for one variable of 4000 numbers, and 1 s longer
// for four of 1000.
constexpr std::uint64_t kMostOfType = 1024;
constexpr std::uint32_t kMostTypeDepth = 16;  // nesting of types
// The rest counts the body of each function at each call of it, because drivers inline calls.
constexpr std::uint64_t kMostVariables = 4096;  // numbers in all variables
constexpr std::uint64_t kMostWork = 32768;  // numbers in the results of instructions
// Nesting of blocks. lavapipe is correct up to 80, and blocks of the program's own surround these.
constexpr std::uint32_t kMostBlocks = 32;
constexpr std::uint32_t kMostCalls = 64;  // nesting of calls

std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    return b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b
               ? std::numeric_limits<std::uint64_t>::max()
               : a * b;
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
    return a > std::numeric_limits<std::uint64_t>::max() - b
               ? std::numeric_limits<std::uint64_t>::max()
               : a + b;
}

struct Type {
    std::uint64_t size = 1;  // numbers
    std::uint32_t depth = 1;
    bool is_pointer = false;
};

struct Call {
    std::uint32_t function = 0;
    std::uint32_t blocks = 0;  // nesting of blocks around the call
};

// Size of a function, with or without the bodies of the functions that it calls.
struct Size {
    std::uint64_t variables = 0;  // numbers
    std::uint64_t work = 0;  // numbers
    std::uint32_t blocks = 0;  // nesting
};

struct Function {
    Size own;
    std::vector<Call> calls;
};

// ---- The judge ----------------------------------------------------------------------------------

class Judge {
public:
    explicit Judge(Words code) : code_(code) {}

    std::optional<SpirvFault> judge() {
        if (code_.size() < kHeader) return fault("is not valid SPIR-V");
        if (code_.size() > kMostCode)
            return fault(
                "is too large: " + std::to_string(code_.size()) + " words of SPIR-V; at most " +
                std::to_string(kMostCode) + " are permitted");
        for (std::size_t at = kHeader; at < code_.size();) {
            const std::size_t count = code_[at] >> 16;
            if (count == 0 || count > code_.size() - at) return fault("is not valid SPIR-V");
            if (auto found = instruction(code_[at] & 0xffff, code_.subspan(at + 1, count - 1)))
                return found;
            at += count;
        }
        if (pending_) return pending_;
        if (!has_entry_point_) return fault("has no entry point");
        return tooLarge();
    }

private:
    std::optional<SpirvFault> fault(std::string text) const {
        return SpirvFault{.file = file_, .line = line_, .text = std::move(text)};
    }
    std::optional<SpirvFault> noPlace(const std::string& what) const {
        return fault(what + " is not permitted in a file that a scene names");
    }

    // Keeps a fault outside functions until an instruction uses the faulty id, because only the
    // instruction has a line. A fault without an id, such as a capability, gives way to one with an
    // id.
    std::optional<SpirvFault>
    declared(std::optional<SpirvFault> found, std::optional<std::uint32_t> id = {}) {
        if (!pending_ || (id && refused_.empty())) pending_ = std::move(found);
        if (id) refused_.insert(*id);
        return std::nullopt;
    }

    std::optional<SpirvFault> instruction(std::uint32_t operation, Words words) {
        const bool is_value = isIn(kValues, operation);
        const bool is_name = isIn(kNames, operation);
        if (!is_value && !is_name && !isIn(kPlain, operation))
            return noPlace(nameIn(kInstructionNames, operation, "SPIR-V's instruction "));
        if (words.size() < (is_value ? 2u : is_name ? 1u : 0u)) return fault("is not valid SPIR-V");
        if (const auto found = usesRefused(operation, words)) return found;
        if (is_name) return declaration(operation, words);
        if (is_value) return value(operation, words);
        return plain(operation, words);
    }

    // Returns the kept fault, with a line, at the first use of a refused id. Refuses ids that are
    // made of refused ones.
    std::optional<SpirvFault> usesRefused(std::uint32_t operation, Words words) {
        if (!pending_ || operation < op::kExtension) return std::nullopt;
        if (std::ranges::none_of(words, [&](auto word) { return refused_.contains(word); }))
            return std::nullopt;
        // Variables are declared at the beginning of a function, so they would give that line.
        if (line_ > 0 && operation != op::kVariable)
            return SpirvFault{.file = file_, .line = line_, .text = pending_->text};
        if (isIn(kNames, operation)) refused_.insert(words[0]);
        if (isIn(kValues, operation)) refused_.insert(words[1]);
        return std::nullopt;
    }

    std::optional<SpirvFault> plain(std::uint32_t operation, Words words) {
        constexpr std::uint32_t kSpecId = 1;
        switch (operation) {
        case op::kLine:
            if (words.size() < 2) return fault("is not valid SPIR-V");
            file_ = strings_[words[0]];
            line_ = static_cast<int>(std::min(words[1], 1u << 30));
            return std::nullopt;
        case op::kNoLine:
            return atNoLine();
        case op::kExtension:
            if (spirvText(words) != kMeshExtension)
                return noPlace("SPIR-V's extension " + spirvText(words));
            return std::nullopt;
        case op::kCapability:
            if (words.empty() || !isIn(kCapabilities, words[0]))
                return declared(
                    noPlace("SPIR-V's capability " + std::to_string(words.empty() ? 0 : words[0])));
            return std::nullopt;
        case op::kMemoryModel:
            if (words.empty() || words[0] != kLogical) return noPlace("memory by an address");
            return std::nullopt;
        case op::kEntryPoint:
            if (words.size() < 2 || has_entry_point_) return fault("has two entry points");
            has_entry_point_ = true;
            entry_point_ = words[1];
            return std::nullopt;
        case spirv::kDecorate:
        case op::kMemberDecorate: {
            const std::size_t at = operation == spirv::kDecorate ? 1 : 2;
            if (words.size() <= at) return fault("is not valid SPIR-V");
            // For a variable's location or built-in, the fault of the variable itself says more.
            if (!isIn(kDecorations, words[at]) || (words[at] == kSpecId && words.size() != at + 2))
                return declared(noPlace("SPIR-V's decoration " + std::to_string(words[at])));
            return std::nullopt;
        }
        case op::kStore:
            if (words.size() < 2) return fault("is not valid SPIR-V");
            return work(sizeOf(words[1]));
        case op::kLoopMerge:
        case op::kSelectionMerge:
            if (words.empty()) return fault("is not valid SPIR-V");
            open_.push_back(words[0]);
            function_.own.blocks =
                std::max(function_.own.blocks, static_cast<std::uint32_t>(open_.size()));
            return std::nullopt;
        case op::kFunctionEnd:
            functions_.insert_or_assign(current_, std::exchange(function_, {}));
            open_.clear();
            current_ = 0;
            return atNoLine();
        default:
            return std::nullopt;
        }
    }

    std::optional<SpirvFault> atNoLine() {
        file_.clear();
        line_ = 0;
        return std::nullopt;
    }

    std::optional<SpirvFault> declaration(std::uint32_t operation, Words words) {
        const std::uint32_t id = words[0];
        const auto has = [&](std::size_t count) { return words.size() > count; };
        Type type;
        switch (operation) {
        case spirv::kString:
            strings_[id] = spirvText(words.subspan(1));
            return std::nullopt;
        case op::kExtInstImport:
            if (spirvText(words.subspan(1)) != kMathematicsSet)
                return noPlace("SPIR-V's instructions " + spirvText(words.subspan(1)));
            return std::nullopt;
        case op::kLabel:
            if (const auto found = std::ranges::find(open_, id); found != open_.end())
                open_.erase(found, open_.end());
            return std::nullopt;
        case op::kTypeInt:
        case op::kTypeFloat:
            if (!has(1) || words[1] != 32)
                return declared(noPlace("a number that does not have 32 bits"), id);
            break;
        case op::kTypeVector:
        case op::kTypeMatrix:
            if (!has(2)) return fault("is not valid SPIR-V");
            type = {.size = product(types_[words[1]].size, words[2])};
            break;
        case op::kTypeArray: {
            if (!has(2)) return fault("is not valid SPIR-V");
            const auto length = constants_.find(words[2]);
            if (length == constants_.end())
                return declared(noPlace("an array whose size is not a number"), id);
            const Type& of = types_[words[1]];
            if (of.is_pointer) return noPlace("a pointer in memory");
            type = {.size = product(of.size, length->second), .depth = of.depth + 1};
            break;
        }
        case op::kTypeStruct:
            type.size = 0;
            for (const std::uint32_t member : words.subspan(1)) {
                const Type& of = types_[member];
                if (of.is_pointer) return noPlace("a pointer in memory");
                type.size = sum(type.size, of.size);
                type.depth = std::max(type.depth, of.depth + 1);
            }
            break;
        case op::kTypePointer:
            if (!has(2)) return fault("is not valid SPIR-V");
            if (words[1] != kFunctionClass)
                return declared(
                    noPlace(nameIn(kClassNames, words[1], "SPIR-V's storage class ")), id);
            if (types_[words[2]].is_pointer) return noPlace("a pointer in memory");
            type.is_pointer = true;
            pointed_[id] = types_[words[2]].size;
            break;
        default:
            break;
        }
        if (type.size > kMostOfType)
            return declared(
                fault(
                    "a type has " + std::to_string(type.size) + " numbers; at most " +
                    std::to_string(kMostOfType) + " are permitted"),
                id);
        if (type.depth > kMostTypeDepth)
            return declared(
                fault("types are nested more than " + std::to_string(kMostTypeDepth) + " deep"),
                id);
        types_[id] = type;
        return std::nullopt;
    }

    std::optional<SpirvFault> value(std::uint32_t operation, Words words) {
        const std::uint32_t type = words[0], id = words[1];
        const bool is_pointer = types_[type].is_pointer;
        const bool may_be_pointer = operation == op::kVariable || operation == op::kAccessChain ||
                                    operation == op::kInBoundsAccessChain ||
                                    operation == op::kFunctionParameter;
        if (is_pointer && !may_be_pointer) return noPlace("a pointer in memory");
        sizes_[id] = types_[type].size;
        switch (operation) {
        case op::kConstant:
            if (words.size() == 3) constants_[id] = words[2];
            return std::nullopt;
        case op::kSpecConstantOp:
            if (words.size() < 3 || !isIn(kValues, words[2]))
                return noPlace("this operation on parameters");
            return std::nullopt;
        case op::kExtInst:
            if (words.size() < 4 || !isIn(kMathematics, words[3]))
                return noPlace(
                    "GLSL.std.450's instruction " +
                    (words.size() < 4 ? "" : std::to_string(words[3])));
            return work(sizes_[id]);
        case spirv::kFunction:
            if (functions_.contains(id)) return fault("defines a function twice");
            current_ = id;
            function_ = {};
            return std::nullopt;
        case op::kFunctionCall:
            if (words.size() < 3) return fault("is not valid SPIR-V");
            function_.calls.push_back({words[2], static_cast<std::uint32_t>(open_.size())});
            return work(sizes_[id]);
        case op::kVariable:
            if (words.size() < 3) return fault("is not valid SPIR-V");
            if (current_ == 0 || !is_pointer || words[2] != kFunctionClass)
                return declared(
                    noPlace(
                        words[2] == kFunctionClass
                            ? "a variable outside functions"
                            : nameIn(kClassNames, words[2], "SPIR-V's storage class ")),
                    id);
            function_.own.variables = sum(function_.own.variables, pointed_[type]);
            return std::nullopt;
        default:
            return current_ == 0 ? std::nullopt : work(sizes_[id]);
        }
    }

    std::uint64_t sizeOf(std::uint32_t id) const {
        const auto found = sizes_.find(id);
        return found == sizes_.end() ? 1 : found->second;
    }

    std::optional<SpirvFault> work(std::uint64_t numbers) {
        function_.own.work = sum(function_.own.work, numbers);
        return std::nullopt;
    }

    // Returns the size of a function with those it calls; none if calls are nested too deep, as in
    // a recursion.
    std::optional<Size> sizeOfCalls(std::uint32_t id, std::uint32_t depth) {
        if (const auto known = whole_.find(id); known != whole_.end()) return known->second;
        if (depth > kMostCalls) return std::nullopt;
        const auto found = functions_.find(id);
        if (found == functions_.end()) return Size{};  // invalid code
        Size size = found->second.own;
        for (const Call& call : found->second.calls) {
            const std::optional<Size> called = sizeOfCalls(call.function, depth + 1);
            if (!called) return std::nullopt;
            size.variables = sum(size.variables, called->variables);
            size.work = sum(size.work, called->work);
            size.blocks = std::max(size.blocks, call.blocks + called->blocks);
        }
        return whole_[id] = size;
    }

    std::optional<SpirvFault> tooLarge() {
        const std::optional<Size> size = sizeOfCalls(entry_point_, 0);
        if (!size)
            return fault(
                "nests calls of functions more than " + std::to_string(kMostCalls) + " deep");
        const auto tooMany = [&](const char* what, std::uint64_t count, std::uint64_t most) {
            return fault(
                std::string("is too large: ") + what + ' ' + std::to_string(count) +
                ", counting the body of each function at each call; at most " +
                std::to_string(most) + " are permitted");
        };
        if (size->variables > kMostVariables)
            return tooMany("numbers in its variables:", size->variables, kMostVariables);
        if (size->work > kMostWork)
            return tooMany("numbers that it computes:", size->work, kMostWork);
        if (size->blocks > kMostBlocks) return tooMany("nested blocks:", size->blocks, kMostBlocks);
        return std::nullopt;
    }

    Words code_;
    std::string file_;
    int line_ = 0;
    std::optional<SpirvFault> pending_;
    std::set<std::uint32_t> refused_;
    bool has_entry_point_ = false;
    std::uint32_t entry_point_ = 0;
    std::map<std::uint32_t, std::string> strings_;
    std::map<std::uint32_t, Type> types_;
    std::map<std::uint32_t, std::uint64_t> pointed_;  // size of what a pointer type points to
    std::map<std::uint32_t, std::uint64_t> sizes_;  // of values
    std::map<std::uint32_t, std::uint32_t> constants_;
    std::uint32_t current_ = 0;  // function; 0: outside functions
    Function function_;
    std::vector<std::uint32_t> open_;  // labels at the ends of open blocks
    std::map<std::uint32_t, Function> functions_;
    std::map<std::uint32_t, Size> whole_;  // sizes with the functions called
};

}  // namespace

std::optional<SpirvFault> judgeSpirv(std::span<const std::uint32_t> code) {
    return Judge(code).judge();
}

}  // namespace engine
