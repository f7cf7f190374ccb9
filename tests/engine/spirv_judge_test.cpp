// Modules in SPIR-V assembly, most of them with one fault.
#include "engine/spirv_judge.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <spirv-tools/libspirv.hpp>

namespace engine {
namespace {

using testing::HasSubstr;

struct Module {
    std::string capabilities{};
    std::string decorations{};
    std::string types{};
    std::string body{};
    std::string functions{};
    std::string memory = "Logical GLSL450";
    std::string stage = "Fragment";
};

std::vector<std::uint32_t> assembled(const Module& module) {
    const std::string text = "OpCapability Shader\n" + module.capabilities + R"(
%mathematics = OpExtInstImport "GLSL.std.450"
OpMemoryModel )" + module.memory +
                             "\nOpEntryPoint " + module.stage + R"( %main "main"
OpExecutionMode %main OriginUpperLeft
%file = OpString "a.glsl"
)" + module.decorations + R"(
%void = OpTypeVoid
%bool = OpTypeBool
%float = OpTypeFloat 32
%uint = OpTypeInt 32 0
%vec4 = OpTypeVector %float 4
%one = OpConstant %float 1
%two = OpConstant %uint 2
%yes = OpConstantTrue %bool
%to_float = OpTypePointer Function %float
%signature = OpTypeFunction %void
)" + module.types + R"(
%main = OpFunction %void None %signature
%entry = OpLabel
%variable = OpVariable %to_float Function
OpLine %file 7 0
OpStore %variable %one
)" + module.body + R"(
OpReturn
OpFunctionEnd
)" + module.functions;
    const spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_6);
    std::vector<std::uint32_t> words;
    EXPECT_TRUE(tools.Assemble(text, &words, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS))
        << text;
    return words;
}

// Returns "a.glsl:7: reason", or "reason" if the place is unknown; empty for a module without
// faults.
std::string faultOf(const std::vector<std::uint32_t>& words) {
    const std::optional<SpirvFault> fault = judgeSpirv(words);
    if (!fault) return {};
    return (fault->line ? fault->file + ':' + std::to_string(fault->line) + ": " : "") +
           fault->text;
}
std::string faultOf(const Module& module) { return faultOf(assembled(module)); }

const std::string kNoPlace = " is not permitted in a file that a scene names";

TEST(SpirvJudge, AllowsFunctionsOfValues) {
    EXPECT_EQ(faultOf(Module{}), "");
    EXPECT_EQ(
        faultOf(Module{
            .decorations = "OpDecorate %sum NoContraction\nOpDecorate %parameter SpecId 3",
            .types = "%parameter = OpSpecConstant %float 2\n"
                     "%three = OpConstant %uint 3\n"
                     "%array = OpTypeArray %vec4 %three\n"
                     "%struct = OpTypeStruct %array %float\n"
                     "%to_struct = OpTypePointer Function %struct",
            .body = "%sum = OpFAdd %float %one %parameter\n"
                    "%sine = OpExtInst %float %mathematics Sin %sum\n"
                    "OpSelectionMerge %end None\n"
                    "OpBranchConditional %yes %end %end\n"
                    "%end = OpLabel"}),
        "");
}

TEST(SpirvJudge, RefusesEveryCapabilityButAStagesOwn) {
    for (const char* const capability :
         {"Float64", "Int64", "Int16", "Float16", "PhysicalStorageBufferAddresses", "ImageQuery",
          "VariablePointers", "GroupNonUniform", "RayQueryKHR", "Addresses", "Linkage", "Kernel",
          "VulkanMemoryModel", "DerivativeControl", "SampleRateShading"})
        EXPECT_THAT(
            faultOf(Module{.capabilities = std::string("OpCapability ") + capability}),
            testing::MatchesRegex("SPIR-V's capability [0-9]+" + kNoPlace))
            << capability;
    for (const char* const capability : {"Matrix", "Tessellation", "Geometry", "MeshShadingEXT"})
        EXPECT_EQ(faultOf(Module{.capabilities = std::string("OpCapability ") + capability}), "")
            << capability;
}

TEST(SpirvJudge, RefusesExtensionsAndOtherMemory) {
    EXPECT_EQ(
        faultOf(Module{.capabilities = "OpExtension \"SPV_KHR_physical_storage_buffer\""}),
        "SPIR-V's extension SPV_KHR_physical_storage_buffer" + kNoPlace);
    EXPECT_EQ(
        faultOf(Module{.capabilities = "%other = OpExtInstImport \"NonSemantic.DebugPrintf\""}),
        "SPIR-V's instructions NonSemantic.DebugPrintf" + kNoPlace);
    EXPECT_EQ(
        faultOf(Module{.memory = "PhysicalStorageBuffer64 GLSL450"}),
        "memory by an address" + kNoPlace);
}

// Other storage classes are refused for variables and for types alone. The line is that of the
// access.
TEST(SpirvJudge, RefusesEveryStorageClassButFunction) {
    for (const char* const storage :
         {"UniformConstant", "Input", "Uniform", "Output", "Workgroup", "CrossWorkgroup", "Private",
          "PushConstant", "StorageBuffer", "PhysicalStorageBuffer", "TaskPayloadWorkgroupEXT"}) {
        const std::string type = std::string("%refused = OpTypePointer ") + storage + " %float\n";
        EXPECT_THAT(faultOf(Module{.types = type}), HasSubstr(kNoPlace)) << storage;
        EXPECT_THAT(
            faultOf(Module{
                .types = type + "%there = OpVariable %refused " + storage,
                .body = "%read = OpLoad %float %there"}),
            testing::AllOf(testing::StartsWith("a.glsl:7: "), HasSubstr(kNoPlace)))
            << storage;
    }
    EXPECT_EQ(
        faultOf(Module{.types = "%there = OpVariable %to_float Function"}),
        "a variable outside functions" + kNoPlace);
}

TEST(SpirvJudge, RefusesPointersInMemory) {
    EXPECT_EQ(
        faultOf(Module{.types = "%struct = OpTypeStruct %to_float"}),
        "a pointer in memory" + kNoPlace);
    EXPECT_EQ(
        faultOf(Module{.types = "%array = OpTypeArray %to_float %two"}),
        "a pointer in memory" + kNoPlace);
    EXPECT_EQ(
        faultOf(Module{.types = "%to_pointer = OpTypePointer Function %to_float"}),
        "a pointer in memory" + kNoPlace);
    for (const char* const made :
         {"OpBitcast %to_float %two", "OpUndef %to_float",
          "OpSelect %to_float %yes %variable %variable", "OpCopyObject %to_float %variable"})
        EXPECT_EQ(
            faultOf(Module{.body = std::string("%made = ") + made}),
            "a.glsl:7: a pointer in memory" + kNoPlace)
            << made;
}

TEST(SpirvJudge, RefusesWhatIsNoMathematics) {
    const std::vector<std::pair<const char*, const char*>> refused{
        {"OpKill\n%after = OpLabel", "'discard'"},
        {"OpTerminateInvocation\n%after = OpLabel", "'discard'"},
        {"%x = OpDPdx %float %one", "a derivative such as dFdx()"},
        {"%x = OpFwidthCoarse %float %one", "a derivative such as dFdx()"},
        {"OpControlBarrier %two %two %two", "a barrier"},
        {"OpMemoryBarrier %two %two", "a barrier"},
        {"%x = OpAtomicIAdd %uint %variable %two %two %two", "an atomic operation"},
        {"OpEmitVertex", "EmitVertex() or EndPrimitive()"},
        {"%x = OpExtInst %float %mathematics InterpolateAtCentroid %variable",
         "GLSL.std.450's instruction 76"},
        {"OpCopyMemory %variable %variable", "SPIR-V's instruction 63"},
        {"%x = OpConvertPtrToU %uint %variable", "SPIR-V's instruction 117"},
        {"%x = OpPtrAccessChain %to_float %variable %two", "SPIR-V's instruction 67"},
        {"%x = OpGroupNonUniformElect %bool %two", "SPIR-V's instruction 333"},
    };
    for (const auto& [text, name] : refused)
        EXPECT_EQ(faultOf(Module{.body = text}), std::string("a.glsl:7: ") + name + kNoPlace);
    EXPECT_THAT(
        faultOf(Module{.types = "%image = OpTypeImage %float 2D 0 0 0 1 Unknown"}),
        testing::StartsWith("an image" + kNoPlace));
    EXPECT_THAT(
        faultOf(Module{.types = "%list = OpTypeRuntimeArray %float"}),
        testing::StartsWith("an array without a size" + kNoPlace));
    for (const char* const type : {"OpTypeFloat 64", "OpTypeFloat 16", "OpTypeInt 64 0"})
        EXPECT_EQ(
            faultOf(Module{.types = std::string("%other = ") + type}),
            "a number that does not have 32 bits" + kNoPlace);
}

TEST(SpirvJudge, RefusesDecorationsThatReachOutside) {
    for (const char* const decoration :
         {"BuiltIn FragCoord", "Location 0", "Binding 0", "DescriptorSet 0", "Block",
          "ArrayStride 4", "Aliased", "LinkageAttributes \"f\" Import"})
        EXPECT_THAT(
            faultOf(Module{.decorations = std::string("OpDecorate %variable ") + decoration}),
            testing::MatchesRegex("SPIR-V's decoration [0-9]+" + kNoPlace))
            << decoration;
}

std::string arrayOf(const std::string& name, const std::string& of, unsigned count) {
    return '%' + name + "_size = OpConstant %uint " + std::to_string(count) + "\n%" + name +
           " = OpTypeArray %" + of + " %" + name + "_size\n";
}

TEST(SpirvJudge, BoundsTypes) {
    const auto fault = [](const std::string& types) { return faultOf(Module{.types = types}); };
    EXPECT_EQ(fault(arrayOf("a", "vec4", 256)), "");
    EXPECT_EQ(
        fault(arrayOf("a", "vec4", 257)), "a type has 1028 numbers; at most 1024 are permitted");
    EXPECT_THAT(fault(arrayOf("a", "float", 0xffffffff)), HasSubstr("at most 1024 are permitted"));
    // 2^66 numbers must not wrap around to 4.
    EXPECT_THAT(
        fault(
            arrayOf("a", "float", 1u << 31) + arrayOf("b", "a", 1u << 31) + arrayOf("c", "b", 16)),
        HasSubstr("at most 1024 are permitted"));
    EXPECT_THAT(
        fault(arrayOf("a", "float", 1024) + "%pair = OpTypeStruct %a %float"),
        HasSubstr("a type has 1025 numbers"));
    std::string deep;
    for (int i = 0; i < 16; ++i)
        deep += arrayOf("a" + std::to_string(i), i ? "a" + std::to_string(i - 1) : "float", 1);
    EXPECT_EQ(fault(deep), "types are nested more than 16 deep");
    EXPECT_EQ(
        fault("%size = OpSpecConstant %uint 2\n%list = OpTypeArray %float %size"),
        "an array whose size is not a number" + kNoPlace);
}

// Returns functions f0 to f<last>. Each calls the previous one `calls` times.
std::string chain(int last, int calls, const std::string& innermost) {
    std::string text;
    for (int i = 0; i <= last; ++i) {
        const std::string name = "%f" + std::to_string(i);
        text += name + " = OpFunction %void None %signature\n" + name + "_entry = OpLabel\n";
        if (i == 0) text += innermost;
        for (int k = 0; i > 0 && k < calls; ++k)
            text += name + '_' + std::to_string(k) + " = OpFunctionCall %void %f" +
                    std::to_string(i - 1) + '\n';
        text += "OpReturn\nOpFunctionEnd\n";
    }
    return text;
}

// A function counts at each call. 4 x 1024 numbers are allowed, and each function that calls twice
// doubles them.
TEST(SpirvJudge, CountsFunctionsWhereTheyAreCalled) {
    const std::string type = arrayOf("a", "float", 1024) + "%to_a = OpTypePointer Function %a\n";
    const auto fault = [&](int last) {
        return faultOf(Module{
            .types = type,
            .body = "%x = OpFunctionCall %void %f" + std::to_string(last),
            .functions = chain(last, 2, "%large = OpVariable %to_a Function\n")});
    };
    // main() adds one number, its own variable.
    EXPECT_EQ(fault(1), "");
    EXPECT_EQ(
        fault(2), "is too large: numbers in its variables: 4097, counting the body of each "
                  "function at each call; at most 4096 are permitted");
    EXPECT_THAT(fault(18), HasSubstr("numbers in its variables: 268435457"));
    EXPECT_THAT(
        faultOf(Module{.body = "%x = OpFunctionCall %void %f18", .functions = chain(18, 2, "")}),
        HasSubstr("numbers that it computes"));
    EXPECT_THAT(
        faultOf(Module{.body = "%x = OpFunctionCall %void %f63", .functions = chain(63, 2, "")}),
        HasSubstr("numbers that it computes"));
}

TEST(SpirvJudge, BoundsDepth) {
    const auto blocks = [](int count) {
        std::string text, ends;
        for (int i = 0; i < count; ++i) {
            const std::string n = std::to_string(i);
            text += "OpSelectionMerge %end" + n + " None\nOpBranchConditional %yes %in" + n +
                    " %end" + n + "\n%in" + n + " = OpLabel\n";
            ends = "OpBranch %end" + n + "\n%end" + n + " = OpLabel\n" + ends;
        }
        return text + ends;
    };
    EXPECT_EQ(faultOf(Module{.body = blocks(32)}), "");
    EXPECT_THAT(faultOf(Module{.body = blocks(33)}), HasSubstr("nested blocks: 33"));
    // Blocks around a call and blocks in the called function add up.
    EXPECT_THAT(
        faultOf(Module{
            .body = "OpSelectionMerge %end None\nOpBranchConditional %yes %in %end\n%in = OpLabel\n"
                    "%x = OpFunctionCall %void %f0\nOpBranch %end\n%end = OpLabel",
            .functions = chain(0, 0, blocks(32))}),
        HasSubstr("nested blocks: 33"));
    EXPECT_THAT(
        faultOf(Module{.body = "%x = OpFunctionCall %void %f70", .functions = chain(70, 1, "")}),
        HasSubstr("more than 64 deep"));
    EXPECT_THAT(
        faultOf(Module{
            .body = "%x = OpFunctionCall %void %f0",
            .functions = chain(0, 0, "%again = OpFunctionCall %void %f0\n")}),
        HasSubstr("more than 64 deep"));
}

TEST(SpirvJudge, BoundsTheModule) {
    std::vector<std::uint32_t> words = assembled({});
    words.resize((std::size_t{1} << 18) + 1, 1u << 16);  // OpNop
    EXPECT_THAT(faultOf(words), HasSubstr("is too large: 262145 words"));
    words.pop_back();
    EXPECT_EQ(faultOf(words), "");
}

TEST(SpirvJudge, RefusesWhatIsCutOff) {
    const std::vector<std::uint32_t> words = assembled({});
    EXPECT_EQ(faultOf(std::vector<std::uint32_t>{}), "is not valid SPIR-V");
    EXPECT_EQ(
        faultOf(std::vector<std::uint32_t>(words.begin(), words.begin() + 5)),
        "has no entry point");
    // Cuts within each instruction. A cut between two of them can leave a whole module.
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16)
        for (std::size_t cut = at + 1; cut < at + (words[at] >> 16); ++cut)
            EXPECT_THAT(
                faultOf(std::vector<std::uint32_t>(
                    words.begin(), words.begin() + static_cast<std::ptrdiff_t>(cut))),
                testing::EndsWith("is not valid SPIR-V"));
}

}  // namespace
}  // namespace engine
