#include "hair/extension.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <map>
#include <optional>
#include <ranges>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/shaders.h"
#include "hair/gpu_structs.h"

namespace hair {
namespace {

// ---- Permitted text of an extension -------------------------------------------------------------

// Returns the text with comments replaced by spaces and with its lines unchanged.
std::string withoutComments(const std::string& text) {
    std::string code = text;
    enum class In { words, line, block } in = In::words;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view two = std::string_view(text).substr(i, 2);
        if (in == In::words && (two == "//" || two == "/*")) {
            in = two == "//" ? In::line : In::block;
            code[i] = code[i + 1] = ' ';
            ++i;
        } else if (in == In::block && two == "*/") {
            in = In::words;
            code[i] = code[i + 1] = ' ';
            ++i;
        } else if (text[i] == '\n') {
            if (in == In::line) in = In::words;
        } else if (in != In::words) {
            code[i] = ' ';
        }
    }
    return code;
}

engine::Error errorAt(const std::string& name, std::size_t line, const std::string& reason) {
    return {name + ':' + std::to_string(line), reason};
}

// Keywords that would let a shader reach memory it was not given.
constexpr std::array kRefused{"buffer", "layout", "shared", "uniform"};
// Words before a call that are not the type of a declaration.
constexpr std::array kBeforeCalls{"return", "else", "do", "case"};

bool isOneOf(const std::string& word, const auto& words) {
    return std::ranges::find(words, word) != words.end();
}

// Nobody needs longer lines, and std::regex can't match them: it takes a stack frame per character.
constexpr std::size_t kLongestLine = 1000;

// Checks that lines end only with '\n', here and for the compiler: the compiler would also end a
// line, and a comment, at a lone '\r'.
void checkLines(const std::string& name, const std::string& text) {
    std::size_t number = 1, length = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            ++number;
            length = 0;
            continue;
        }
        if (++length > kLongestLine)
            throw errorAt(
                name, number, "is longer than " + std::to_string(kLongestLine) + " characters");
        const bool ends = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        const bool control = static_cast<unsigned char>(text[i]) < ' ' || text[i] == '\x7f';
        if (control && text[i] != '\t' && !ends)
            throw errorAt(name, number, "has a control character");
        // A backslash at the end of a line continues the line, or a comment, on the next one.
        if (text[i] == '\\')
            throw errorAt(name, number, "'\\' is not permitted in a file that a scene names");
    }
}

void checkWords(const std::string& name, const std::string& text) {
    static const std::regex word(R"([A-Za-z_]\w*)");
    static const std::regex directive(R"(\s*#\s*(\w*).*)");
    std::istringstream lines(withoutComments(text));
    std::smatch match;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (std::regex_match(line, match, directive))
            throw errorAt(
                name, number,
                '#' + match[1].str() + " is not permitted in a file that a scene names");
        for (std::sregex_iterator each(line.begin(), line.end(), word), end; each != end; ++each)
            if (isOneOf(each->str(), kRefused))
                throw errorAt(
                    name, number,
                    '\'' + each->str() +
                        "' is not permitted in a file that a scene names: it reads only its "
                        "parameters and its functions' arguments");
    }
}

struct Token {
    std::string text;  // a word, or any other single character
    std::size_t line = 1;
    std::size_t at = 0;  // in the code

    bool isWord() const {
        return std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '_';
    }
};

std::vector<Token> tokensOf(const std::string& code) {
    const auto isIn = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    std::vector<Token> tokens;
    std::size_t line = 1;
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] == '\n') ++line;
        if (std::isspace(static_cast<unsigned char>(code[i]))) continue;
        std::size_t end = i + 1;
        if (isIn(code[i]))
            while (end < code.size() && isIn(code[end])) ++end;
        tokens.push_back({code.substr(i, end - i), line, i});
        i = end - 1;
    }
    return tokens;
}

// Whether the tokens before the name at `at` make it a declaration: "float f(", "float[2] f(",
// "struct S { float x; } f(". To the linker, variables and functions declared in two units are the
// same. A function that is declared but not defined would become the program's own function of that
// name, if there is one, and some of those take addresses.
bool isDeclared(const std::vector<Token>& tokens, std::size_t at, bool after_struct) {
    if (at == 0) return false;
    const Token& before = tokens[at - 1];
    if (before.isWord()) return !isOneOf(before.text, kBeforeCalls);
    return before.text == "]" || (before.text == "}" && after_struct);
}

// Returns the token that closes the parenthesis at `at`, or the end of the tokens.
std::size_t closing(const std::vector<Token>& tokens, std::size_t at) {
    for (std::size_t depth = 0; at < tokens.size(); ++at) {
        if (tokens[at].text == "(") ++depth;
        if (tokens[at].text == ")" && --depth == 0) break;
    }
    return at;
}

void checkFunctions(const std::string& name, const std::string& text) {
    const std::vector<Token> tokens = tokensOf(withoutComments(text));
    enum class Block { body, members, list };
    std::vector<Block> blocks;  // that are open
    bool after_struct = false;
    std::size_t start = 0;  // of a declaration outside functions
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "{") {
            const bool is_struct = (i >= 1 && tokens[i - 1].text == "struct") ||
                                   (i >= 2 && tokens[i - 2].text == "struct");
            const bool is_list = i >= 1 && tokens[i - 1].text == "=";
            blocks.push_back(is_struct ? Block::members : is_list ? Block::list : Block::body);
        }
        if (tokens[i].text == "}" && !blocks.empty()) {
            const Block closed = blocks.back();
            after_struct = closed == Block::members;
            blocks.pop_back();
            if (blocks.empty() && closed == Block::body) start = i + 1;  // end of a function
        }
        if (tokens[i].text == ";" && blocks.empty()) {
            const bool is_struct = i > 0 && tokens[i - 1].text == "}" && after_struct;
            if (start < i && tokens[start].text != "const" && !is_struct)
                throw errorAt(
                    name, tokens[start].line,
                    "a declaration outside functions must be const, because otherwise it would be "
                    "the program's own variable of that name");
            start = i + 1;
        }
        if (tokens[i].text != "(" || i == 0 || !tokens[i - 1].isWord() ||
            !isDeclared(tokens, i - 1, after_struct))
            continue;
        const std::size_t end = closing(tokens, i);
        if (end + 1 >= tokens.size() || tokens[end + 1].text != "{")
            throw errorAt(
                name, tokens[i - 1].line,
                '\'' + tokens[i - 1].text +
                    "' is declared but not defined, which is not permitted in a file that a scene "
                    "names");
    }
}

// Returns the text with engine::kNextTurn in the condition of each loop, so that every loop ends
// (shaders/extension/turns.glsl). Lines stay as they are. Malformed loops are left to the compiler.
std::string withBoundLoops(const std::string& name, const std::string& text) {
    const std::vector<Token> tokens = tokensOf(withoutComments(text));
    std::map<std::size_t, std::string> inserted;  // by place in the text
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        const bool is_for = tokens[i].text == "for";
        if ((!is_for && tokens[i].text != "while") || tokens[i + 1].text != "(") continue;
        const std::size_t end = closing(tokens, i + 1);
        if (end == tokens.size()) break;
        std::size_t first = i + 2, last = end;  // of the condition; exclusive
        if (is_for) {
            const auto semicolon = [&](std::size_t from) {
                while (from < end && tokens[from].text != ";") ++from;
                return from;
            };
            first = semicolon(first) + 1;
            last = semicolon(first);
            if (last >= end) continue;
        } else if (first == last) {
            continue;
        }
        if (first + 1 < last && tokens[first].isWord() && tokens[first + 1].isWord())
            throw errorAt(
                name, tokens[first].line,
                "a loop's condition declares a variable: declare it before the loop");
        const std::string turn = engine::kNextTurn + std::string("()");
        if (first == last) {
            inserted[tokens[last].at] = turn;
        } else {
            inserted[tokens[first].at] = turn + " && (";
            inserted[tokens[last].at] = ")";
        }
    }
    std::string bound = text;
    for (const auto& [at, added] : inserted | std::views::reverse) bound.insert(at, added);
    return bound;
}

// ---- Declarations of parameters -----------------------------------------------------------------

constexpr const char* kForm = "expected // @parameter NAME DEFAULT [LEAST, MOST] UNIT: meaning";

std::optional<double> numberIn(const std::string& text) {
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    double number = 0.0;
    stream >> number;
    if (stream.fail() || !(stream >> std::ws).eof() || !std::isfinite(number)) return std::nullopt;
    return number;
}

// Reads "0.5" or "(0.1, 0.2, 0.3)".
bool readOriginal(const std::string& text, ExtensionParameter& parameter) {
    static const std::regex vector(R"(\(([^,]*),([^,]*),([^,]*)\))");
    std::smatch parts;
    parameter.is_vector = std::regex_match(text, parts, vector);
    for (int i = 0; i < (parameter.is_vector ? 3 : 1); ++i) {
        const std::string part =
            parameter.is_vector ? parts[static_cast<std::size_t>(i) + 1].str() : text;
        const std::optional<double> number = numberIn(part);
        if (!number || *number < parameter.minimum || *number > parameter.maximum) return false;
        parameter.original[i] = static_cast<float>(*number);
    }
    return true;
}

ExtensionParameter
parameterIn(const std::string& name, std::size_t line, const std::string& declaration) {
    static const std::regex form(
        R"(\s+([a-z][a-z0-9_]*)\s+(\([^)]*\)|[^\s\[]+)\s*\[([^,\]]+),([^\]]+)\]\s*(\S+):\s*(.*\S)\s*)");
    std::smatch parts;
    if (!std::regex_match(declaration, parts, form)) throw errorAt(name, line, kForm);
    const std::optional<double> minimum = numberIn(parts[3]), maximum = numberIn(parts[4]);
    if (!minimum || !maximum || *minimum >= *maximum)
        throw errorAt(
            name, line,
            "[" + parts[3].str() + "," + parts[4].str() +
                "] is not a range: expected two numbers, the first below the second");
    if (std::max(-*minimum, *maximum) > double{std::numeric_limits<float>::max()})
        throw errorAt(
            name, line,
            "[" + parts[3].str() + "," + parts[4].str() +
                "] exceeds the range of 32-bit numbers, which ends at 3.4e38");
    ExtensionParameter parameter{
        .name = parts[1],
        .minimum = *minimum,
        .maximum = *maximum,
        .unit = parts[5],
        .help = parts[6]};
    if (!readOriginal(parts[2], parameter))
        throw errorAt(
            name, line, parts[2].str() + " is neither a number nor (x, y, z) within the range");
    return parameter;
}

// ---- Parts of shaders ---------------------------------------------------------------------------

struct Part {
    const char* interface;
    const char* macro;
    std::uint32_t first_constant;
    const char* function;  // this and the next: as in engine::ShaderExtension
    const char* stand_in;
};

// In the order of ExtensionKind.
constexpr std::array kParts{
    Part{
        "extension/shading.glsl", "HAIRBENCH_EXTENDED_SHADING", gpu::kShadingParameterConstant,
        "vec3 shadeHair(HairPoint point)", R"(
uint lightCount() { return 1u; }
HairLight hairLight(HairPoint point, uint light) {
    return HairLight(point.normal, point.color, 1.0);
}
HairShading hairShading() { return HairShading(0.0, 0.0, 0.0, 0.0); }
vec3 workingColor(vec3 display) { return display; }
void main() {
    HairPoint point;
    shadeHair(point);
}
)"},
    Part{
        "extension/offset.glsl", "HAIRBENCH_EXTENDED_OFFSET", gpu::kOffsetParameterConstant,
        "vec3 offsetHair(HairPlace place)", R"(
float hairRandom(HairPlace place, uint which) { return 0.0; }
void main() {
    HairPlace place;
    offsetHair(place);
}
)"},
    Part{
        "extension/force.glsl", "HAIRBENCH_EXTENDED_FORCE", gpu::kForceParameterConstant,
        "vec3 accelerateGuide(GuidePoint point)", R"(
float guideRandom(GuidePoint point, uint which) { return 0.0; }
void main() {
    GuidePoint point;
    accelerateGuide(point);
}
)"},
    Part{
        "extension/solver.glsl", "HAIRBENCH_EXTENDED_SOLVER", gpu::kSolverParameterConstant,
        "void solveGuide(Guide guide)", R"(
vec3 guidePosition(uint vertex) { return vec3(0.0); }
void setGuidePosition(uint vertex, vec3 position) {}
bool guideHeld(uint vertex) { return vertex == 0u; }
vec3 guideBefore(uint vertex) { return vec3(0.0); }
vec3 guideVelocity(uint vertex) { return vec3(0.0); }
vec3 guideAcceleration(uint vertex) { return vec3(0.0); }
vec3 guideDrift(uint vertex, vec3 velocity) { return velocity; }
vec3 guidePredicted(uint vertex) { return vec3(0.0); }
float guideYield(uint vertex) { return 1.0; }
vec3 guideRest(uint vertex) { return vec3(0.0); }
float guideRestLength(uint vertex) { return 0.0; }
float guideMass(uint vertex) { return 0.0; }
GuideMaterial guideMaterial() { return GuideMaterial(0.0, 0.0, 0.0, 0.0, 0.0, 0.0); }
vec3 outOfBodies(uint vertex, vec3 position) { return position; }
vec4 guideMemory(uint vertex, uint place) { return vec4(0.0); }
void setGuideMemory(uint vertex, uint place, vec4 value) {}
float guideRandom(Guide guide, uint which) { return 0.0; }
void main() {
    Guide guide;
    solveGuide(guide);
}
)"},
    Part{
        "extension/curve.glsl", "HAIRBENCH_EXTENDED_CURVE", gpu::kCurveParameterConstant,
        "HairCurvePoint curveHair(HairSegment segment, float t)", R"(
void main() {
    HairSegment segment;
    curveHair(segment, 0.5);
}
)"}};

const Part& partOf(ExtensionKind kind) { return kParts[static_cast<std::size_t>(kind)]; }

std::uint32_t constantOf(ExtensionKind kind, std::size_t parameter) {
    return partOf(kind).first_constant + 3 * static_cast<std::uint32_t>(parameter);
}

std::string literal(float value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(9);
    text << std::scientific << value;
    return text.str();
}

// Returns a declaration on one line, the line of the parameter in the file.
std::string declarationOf(const ExtensionParameter& parameter, std::uint32_t constant) {
    const auto scalar = [&](const std::string& name, int component) {
        return "layout(constant_id = " +
               std::to_string(constant + static_cast<std::uint32_t>(component)) + ") const float " +
               name + " = " + literal(parameter.original[component]) + "; ";
    };
    if (!parameter.is_vector) return scalar(parameter.name, 0);
    std::string text;
    for (int i = 0; i < 3; ++i) text += scalar(parameter.name + '_' + "xyz"[i], i);
    return text + "const vec3 " + parameter.name + " = vec3(" + parameter.name + "_x, " +
           parameter.name + "_y, " + parameter.name + "_z);";
}

}  // namespace

Extension parseExtension(ExtensionKind kind, const std::string& name, const std::string& text) {
    checkLines(name, text);
    checkWords(name, text);
    checkFunctions(name, text);
    static const std::regex line_form(R"(\s*//\s*@parameter\b(.*))");
    Extension extension{.kind = kind, .text = text, .parameters = {}, .shader = {}};
    std::istringstream lines(text);
    std::string declarations;
    std::size_t number = 0;
    std::smatch match;
    for (std::string line; std::getline(lines, line); declarations += '\n') {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        if (!std::regex_match(line, match, line_form)) continue;
        ExtensionParameter parameter = parameterIn(name, number, match[1]);
        if (std::ranges::count(extension.parameters, parameter.name, &ExtensionParameter::name) > 0)
            throw errorAt(name, number, '\'' + parameter.name + "' is declared twice");
        if (extension.parameters.size() == kMostExtensionParameters)
            throw errorAt(
                name, number,
                "the file declares more than " + std::to_string(kMostExtensionParameters) +
                    " parameters");
        declarations += declarationOf(parameter, constantOf(kind, extension.parameters.size()));
        extension.parameters.push_back(std::move(parameter));
    }
    const Part& part = partOf(kind);
    extension.shader = std::make_shared<const engine::ShaderExtension>(engine::ShaderExtension{
        .interface = part.interface,
        .macro = part.macro,
        .declarations = std::move(declarations),
        .name = name,
        .text = withBoundLoops(name, text),
        .function = part.function,
        .stand_in = part.stand_in});
    return extension;
}

engine::ShaderExtensions shaderExtensions(const ExtensionParameters& parameters) {
    if (!parameters.file) return {};
    return {parameters.file->shader};
}

engine::Constants extensionConstants(const ExtensionParameters& parameters) {
    engine::Constants constants;
    if (!parameters.file) return constants;
    const std::vector<ExtensionParameter>& declared = parameters.file->parameters;
    for (std::size_t i = 0; i < declared.size(); ++i) {
        const auto set =
            std::ranges::find(parameters.values, declared[i].name, &ExtensionValue::name);
        const glm::vec3 value = set == parameters.values.end() ? declared[i].original : set->value;
        const std::uint32_t first = constantOf(parameters.file->kind, i);
        for (int component = 0; component < (declared[i].is_vector ? 3 : 1); ++component)
            constants.emplace_back(first + static_cast<std::uint32_t>(component), value[component]);
    }
    return constants;
}

float extensionNumber(const ExtensionParameters& parameters, const char* name) {
    const auto set = std::ranges::find(parameters.values, name, &ExtensionValue::name);
    if (set != parameters.values.end()) return set->value.x;
    if (!parameters.file) return 0.0f;
    const auto& declared = parameters.file->parameters;
    const auto found = std::ranges::find(declared, name, &ExtensionParameter::name);
    return found == declared.end() ? 0.0f : found->original.x;
}

}  // namespace hair
