#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Tests the one definition rule over a whole program. If two files define types or functions with
// the same name in the same namespace, the linker silently keeps one. No compiler sees both. So the
// test reads names from the sources, with a tokenizer and a reader of declarations in namespaces.
// Members belong to their class, and everything in a function or an anonymous namespace belongs to
// its file.
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Tokens = std::vector<std::string>;

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool isIdentifier(const std::string& token) {
    return isWord(token.front()) && !std::isdigit(static_cast<unsigned char>(token.front()));
}

// Splits a source into identifiers, numbers and punctuation. Every character or string literal is
// `""`. Skips comments and preprocessor lines, so it reads all branches of an #if.
class Tokenizer {
public:
    explicit Tokenizer(std::string_view text) : text_(text) {}

    Tokens tokens() {
        while (at_ < text_.size()) step();
        return std::move(tokens_);
    }

private:
    bool startsWith(std::string_view what) const { return text_.substr(at_).starts_with(what); }

    void skipPast(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        at_ = found == std::string_view::npos ? text_.size() : found + end.size();
    }

    void step() {
        const char c = text_[at_];
        if (c == '\n') {
            line_begins_ = true;
            ++at_;
        } else if (std::isspace(static_cast<unsigned char>(c))) {
            ++at_;
        } else if (startsWith("//")) {
            skipPast("\n");
            line_begins_ = true;
        } else if (startsWith("/*")) {
            at_ += 2;
            skipPast("*/");
        } else if (c == '#' && line_begins_) {
            skipDirective();
        } else {
            line_begins_ = false;
            token();
        }
    }

    void skipDirective() {
        for (; at_ < text_.size() && text_[at_] != '\n'; ++at_)
            if (text_[at_] == '\\') ++at_;
    }

    void token() {
        const char c = text_[at_];
        if (std::isdigit(static_cast<unsigned char>(c))) {
            number();
        } else if (isWord(c)) {
            word();
        } else if (c == '"' || c == '\'') {
            literal(c);
        } else {
            punctuation();
        }
    }

    // Reads e.g. 1'000'000 and 1.5e-3f. A digit separator begins no character literal.
    void number() {
        const std::size_t begin = at_;
        for (++at_; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            const char before = text_[at_ - 1];
            const bool sign = (c == '+' || c == '-') && (before == 'e' || before == 'E');
            if (!isWord(c) && c != '.' && c != '\'' && !sign) break;
        }
        tokens_.emplace_back(text_.substr(begin, at_ - begin));
    }

    void word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && isWord(text_[at_])) ++at_;
        const std::string_view word = text_.substr(begin, at_ - begin);
        const bool quoted = at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'');
        if (quoted &&
            (word == "R" || word == "u8R" || word == "uR" || word == "UR" || word == "LR")) {
            const std::size_t open = text_.find('(', at_);
            std::string end(1, ')');
            end += text_.substr(at_ + 1, open - at_ - 1);
            at_ = open;
            skipPast(end + '"');
            tokens_.emplace_back("\"\"");
        } else if (quoted && (word == "u8" || word == "u" || word == "U" || word == "L")) {
            literal(text_[at_]);
        } else {
            tokens_.emplace_back(word);
        }
    }

    void literal(char quote) {
        for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_)
            if (text_[at_] == '\\') ++at_;
        ++at_;
        tokens_.emplace_back("\"\"");
    }

    // Each '>' is a token, because ">>" can end two lists of template arguments.
    void punctuation() {
        for (const std::string_view pair : {"::", "->", "==", "!=", "<=", "<<", "&&", "||"})
            if (startsWith(pair)) {
                tokens_.emplace_back(pair);
                at_ += pair.size();
                return;
            }
        tokens_.emplace_back(1, text_[at_++]);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    bool line_begins_ = true;
    Tokens tokens_;
};

// Files that hold a definition, by e.g. "type benchmarks::Side".
using Definitions = std::map<std::string, std::set<std::string>>;

std::string joined(Tokens::const_iterator begin, Tokens::const_iterator end) {
    std::string text;
    for (; begin != end; ++begin) {
        const bool apart = !text.empty() && isWord(text.back()) && isWord(begin->front());
        text += (apart ? " " : "") + *begin;
    }
    return text;
}

// Returns the index after the bracket that closes the one at `open`, or the end.
std::size_t pastBracket(const Tokens& tokens, std::size_t open) {
    std::size_t depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i] == "(" || tokens[i] == "[" || tokens[i] == "{") ++depth;
        if (tokens[i] == ")" || tokens[i] == "]" || tokens[i] == "}")
            if (--depth == 0) return i + 1;
    }
    return tokens.size();
}

// Returns the same for '<' and '>'. A comparison between them must be in parentheses.
std::size_t pastAngle(const Tokens& tokens, std::size_t open) {
    std::size_t depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i] == "(" || tokens[i] == "[" || tokens[i] == "{") {
            i = pastBracket(tokens, i) - 1;
        } else if (tokens[i] == "<") {
            ++depth;
        } else if (tokens[i] == ">" && --depth == 0) {
            return i + 1;
        }
    }
    return tokens.size();
}

// Returns a parameter's type: without its default and, if the last word can be a name, without it.
std::string parameterType(Tokens tokens) {
    static const std::set<std::string> kNoName{"const", "int",   "char",   "long", "short",
                                               "bool",  "float", "double", "auto", "unsigned"};
    tokens.erase(std::ranges::find(tokens, "="), tokens.end());
    const bool named = tokens.size() > 1 && isIdentifier(tokens.back()) &&
                       !kNoName.contains(tokens.back()) && tokens[tokens.size() - 2] != "::";
    return joined(tokens.begin(), tokens.end() - (named ? 1 : 0));
}

// Returns the types of the parameters in parentheses: "(const Side&,int)".
std::string parameterTypes(const Tokens& tokens) {
    std::string text = "(";
    Tokens parameter;
    const auto add = [&] {
        if (!parameter.empty()) text += (text.size() > 1 ? "," : "") + parameterType(parameter);
        parameter.clear();
    };
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        std::size_t end = i + 1;
        if (tokens[i] == "<") end = pastAngle(tokens, i);
        if (tokens[i] == "(" || tokens[i] == "[" || tokens[i] == "{") end = pastBracket(tokens, i);
        if (tokens[i] == ",")
            add();
        else
            parameter.insert(
                parameter.end(), tokens.begin() + static_cast<std::ptrdiff_t>(i),
                tokens.begin() + static_cast<std::ptrdiff_t>(end));
        i = end - 1;
    }
    add();
    return text + ")";
}

// Reads the declarations of a file and enters what it defines with external linkage.
class Reader {
public:
    Reader(std::string_view text, std::string file, Definitions& definitions)
        : tokens_(Tokenizer(text).tokens()), file_(std::move(file)), definitions_(definitions) {}

    // Reads the file. Returns whether all brackets match.
    bool read() {
        readScope("");
        return at_ == tokens_.size();
    }

private:
    void readScope(const std::string& scope) {
        while (at_ < tokens_.size() && tokens_[at_] != "}") readDeclaration(scope);
    }

    void skipBrackets() { at_ = pastBracket(tokens_, at_); }

    void skipToSemicolon() {
        while (at_ < tokens_.size() && tokens_[at_] != ";")
            if (tokens_[at_] == "{" || tokens_[at_] == "(")
                skipBrackets();
            else
                ++at_;
        ++at_;
    }

    void add(const std::string& scope, const std::string& what, const std::string& name) {
        definitions_[what + (scope.empty() ? "" : scope + "::") + name].insert(file_);
    }

    void readDeclaration(const std::string& scope) {
        Tokens declaration;
        while (at_ < tokens_.size() && tokens_[at_] != "}") {
            const std::string& token = tokens_[at_];
            if (token == ";") {
                ++at_;
                readVariable(scope, declaration);
                return;
            }
            if (token == "{") {
                if (readBody(scope, declaration)) return;
                declaration.emplace_back("{}");  // an initializer
                skipBrackets();
                continue;
            }
            const std::size_t begin = at_;
            if (token == "(" || token == "[")
                skipBrackets();
            else
                ++at_;
            declaration.insert(
                declaration.end(), tokens_.begin() + static_cast<std::ptrdiff_t>(begin),
                tokens_.begin() + static_cast<std::ptrdiff_t>(at_));
        }
    }

    // Called at a '{'. Returns false if it begins an initializer.
    bool readBody(const std::string& scope, const Tokens& declaration) {
        if (std::ranges::count(declaration, "namespace") > 0) {
            readNamespace(scope, declaration);
            return true;
        }
        if (declaration == Tokens{"extern", "\"\""}) {
            ++at_;
            readScope(scope);
            ++at_;
            return true;
        }
        if (const std::string type = typeName(declaration); !type.empty()) {
            if (type != "unnamed") add(scope, "type ", type);
            skipBrackets();
            skipToSemicolon();
            return true;
        }
        const std::size_t open = parametersOf(declaration);
        if (open == declaration.size() || isInitialized(declaration, open)) return false;
        addFunction(scope, declaration, open);
        skipBrackets();
        return true;
    }

    void readNamespace(const std::string& scope, const Tokens& declaration) {
        const auto key = std::ranges::find(declaration, "namespace");
        const std::string name = joined(key + 1, declaration.end());
        if (name.empty()) {  // a namespace without a name: everything in it belongs to the file
            skipBrackets();
            return;
        }
        ++at_;
        readScope(scope.empty() ? name : scope + "::" + name);
        ++at_;
    }

    static std::size_t pastTemplate(const Tokens& declaration) {
        std::size_t at = 0;
        while (at + 1 < declaration.size() && declaration[at] == "template" &&
               declaration[at + 1] == "<")
            at = pastAngle(declaration, at + 1);
        return at;
    }

    // Returns the name if a type's body follows the declaration, e.g. "Slot", "FrameLoop::Slot" or
    // "hash<Side>", "unnamed" for a type without a name, and "" otherwise.
    static std::string typeName(const Tokens& declaration) {
        static const std::set<std::string> kKeys{"class", "struct", "union", "enum"};
        std::size_t at = pastTemplate(declaration);
        while (at < declaration.size() && !kKeys.contains(declaration[at])) {
            if (declaration[at] == "(" || declaration[at] == "=") return {};
            ++at;
        }
        if (at == declaration.size()) return {};
        while (at < declaration.size() && kKeys.contains(declaration[at])) ++at;
        while (at < declaration.size() && (declaration[at] == "[" || declaration[at] == "alignas"))
            at = pastBracket(declaration, declaration[at] == "[" ? at : at + 1);
        if (at == declaration.size() || declaration[at] == ":") return "unnamed";
        const std::size_t name = at;
        while (at < declaration.size() && declaration[at] != ":" && declaration[at] != "final") {
            if (declaration[at] == "<") {
                at = pastAngle(declaration, at);
            } else if (
                isIdentifier(declaration[at]) && (at == name || declaration[at - 1] == "::")) {
                ++at;
            } else if (declaration[at] == "::") {
                ++at;
            } else {
                return {};  // "struct Side side", "struct Side* make()"
            }
        }
        return joined(
            declaration.begin() + static_cast<std::ptrdiff_t>(name),
            declaration.begin() + static_cast<std::ptrdiff_t>(at));
    }

    // Returns the index of the '(' before a function's parameters, or the end.
    static std::size_t parametersOf(const Tokens& declaration) {
        static const std::set<std::string> kOthers{"decltype", "alignas", "noexcept", "explicit"};
        for (std::size_t at = pastTemplate(declaration); at < declaration.size(); ++at) {
            if (declaration[at] == "operator" && at + 1 < declaration.size()) {
                at += declaration[at + 1] == "(" ? 3 : 2;  // "operator()", "operator=="
                while (at < declaration.size() && declaration[at] != "(") ++at;
                return at;
            }
            if (declaration[at] == "=" || declaration[at] == "{}") return declaration.size();
            if (declaration[at] == "[") at = pastBracket(declaration, at) - 1;
            if (declaration[at] != "(") continue;
            if (at == 0) return declaration.size();
            if (!kOthers.contains(declaration[at - 1])) return at;
            at = pastBracket(declaration, at) - 1;
        }
        return declaration.size();
    }

    // Whether an initializer follows the parameters: of a member, "Side() : name_{", or of a
    // variable that only looks like a function.
    static bool isInitialized(const Tokens& declaration, std::size_t open) {
        bool members = false;
        for (std::size_t at = pastBracket(declaration, open); at < declaration.size(); ++at) {
            if (declaration[at] == "=") return true;
            members |= declaration[at] == ":";
        }
        return members && (isIdentifier(declaration.back()) || declaration.back() == ">");
    }

    void addFunction(const std::string& scope, const Tokens& declaration, std::size_t open) {
        if (std::ranges::count(declaration, "static") > 0) return;
        const std::size_t templated = pastTemplate(declaration);
        const auto from = declaration.begin() + static_cast<std::ptrdiff_t>(templated);
        const auto parenthesis = declaration.begin() + static_cast<std::ptrdiff_t>(open);
        auto name = std::find(from, parenthesis, "operator");
        if (name == parenthesis) --name;
        while (name != from && (*(name - 1) == "::" || *(name - 1) == "~" || *name == "::")) --name;
        const std::size_t close = pastBracket(declaration, open);
        const auto past = declaration.begin() + static_cast<std::ptrdiff_t>(close);
        std::string text = joined(name, parenthesis) + parameterTypes({parenthesis + 1, past - 1});
        if (past != declaration.end() && *past == "const") text += " const";
        if (templated > 0) text += " of " + joined(declaration.begin(), from);
        add(scope, "function ", text);
    }

    // Reads inline variables and concepts. Other variables belong to their file, or the linker
    // finds duplicates.
    void readVariable(const std::string& scope, const Tokens& declaration) {
        const bool is_concept = std::ranges::count(declaration, "concept") > 0;
        if (!is_concept && (declaration.empty() || declaration.front() != "inline")) return;
        if (parametersOf(declaration) != declaration.size()) return;
        auto end = std::ranges::find_if(declaration, [](const std::string& token) {
            return token == "=" || token == "{}" || token == "[";
        });
        if (end == declaration.begin() || !isIdentifier(*(end - 1))) return;
        add(scope, is_concept ? "concept " : "variable ", *(end - 1));
    }

    Tokens tokens_;
    std::size_t at_ = 0;
    std::string file_;
    Definitions& definitions_;
};

struct File {
    std::string name;
    std::string text;
};

// Returns e.g. "type benchmarks::Side: a.h b.h" for each name that several files define, and the
// files in which brackets do not match.
std::vector<std::string> doubleDefinitions(const std::vector<File>& files) {
    Definitions definitions;
    std::vector<std::string> found;
    for (const File& file : files)
        if (!Reader(file.text, file.name, definitions).read())
            found.push_back(file.name + ": a bracket has no partner");
    for (const auto& [definition, holders] : definitions) {
        if (holders.size() < 2) continue;
        std::string text = definition + ':';
        for (const std::string& holder : holders) text += ' ' + holder;
        found.push_back(std::move(text));
    }
    return found;
}

std::vector<std::string> doubleDefinitions(const std::string& a, const std::string& b) {
    return doubleDefinitions(std::vector<File>{{"a.h", a}, {"b.h", b}});
}

std::vector<std::string> definitionsOf(const std::string& text) {
    Definitions definitions;
    EXPECT_TRUE(Reader(text, "a.h", definitions).read());
    std::vector<std::string> names;
    for (const auto& [definition, holders] : definitions) names.push_back(definition);
    return names;
}

std::vector<File> sources() {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    std::vector<File> files;
    for (const char* const folder : {"engine", "hair", "benchmarks", "tests"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension().string();
            if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) continue;
            std::ifstream stream(entry.path());
            files.push_back(
                {std::filesystem::relative(entry.path(), root).generic_string(),
                 {std::istreambuf_iterator<char>(stream), {}}});
        }
    return files;
}

// Includes the tests, which link most of the program and put helpers into its namespaces. Each file
// with a main() is a separate program. Each system compiles its own files of engine/system.
TEST(OneDefinition, HoldsInEverySource) {
    for (const std::string_view other : {"_windows.cpp", "_linux.cpp"}) {
        std::vector<File> files = sources();
        const auto left_out = std::erase_if(files, [&](const File& file) {
            return file.name.starts_with("engine/system/") && file.name.ends_with(other);
        });
        EXPECT_GT(left_out, 0u) << other;
        std::vector<std::string> doubles = doubleDefinitions(files);
        std::erase_if(doubles, [](const std::string& definition) {
            return definition.starts_with("function main(int,char**): ");
        });
        EXPECT_THAT(doubles, IsEmpty());
    }
}

// Both systems' files of a unit define the same functions. A destructor may be defaulted.
TEST(OneDefinition, SystemsOfferTheSame) {
    std::map<std::string, std::vector<std::string>> systems;
    for (const File& file : sources()) {
        if (!file.name.starts_with("engine/system/") || !file.name.ends_with(".cpp")) continue;
        Definitions definitions;
        EXPECT_TRUE(Reader(file.text, file.name, definitions).read());
        const std::string system = file.name.substr(file.name.rfind('_'));
        for (const auto& [definition, holders] : definitions)
            if (definition.starts_with("function engine::system::") &&
                definition.find("::~") == std::string::npos)
                systems[system].push_back(definition);
    }
    EXPECT_THAT(systems, testing::SizeIs(2));
    for (auto& [system, functions] : systems) std::ranges::sort(functions);
    EXPECT_GT(systems["_linux.cpp"].size(), 40u);
    EXPECT_EQ(systems["_linux.cpp"], systems["_windows.cpp"]);
}

// The reader must know all types that a pattern finds at the beginning of headers' lines.
TEST(OneDefinition, IsReadFromEveryHeader) {
    static const std::regex pattern(
        R"((?:class|struct|enum class|union) (\w+)(?: final)?(?: :.*)? \{.*)");
    std::size_t types = 0;
    for (const File& file : sources()) {
        if (!file.name.ends_with(".h")) continue;
        Definitions definitions;
        Reader(file.text, file.name, definitions).read();
        std::istringstream lines(file.text);
        std::smatch match;
        for (std::string line; std::getline(lines, line);) {
            if (line.size() > 200 || !std::regex_match(line, match, pattern)) continue;
            ++types;
            const std::string name = match[1];
            EXPECT_TRUE(std::ranges::any_of(
                definitions,
                [&](const auto& each) {
                    return each.first == "type " + name || each.first.ends_with("::" + name);
                }))
                << file.name << ": " << line;
        }
    }
    EXPECT_GT(types, 0u);
}

// A gate compares two sides, and so does a window. Neither includes the other's header.
TEST(OneDefinition, FindsTwoTypesOfOneName) {
    EXPECT_THAT(
        doubleDefinitions(
            "#pragma once\nnamespace benchmarks {\nstruct Side {\n    char name = 'A';\n};\n}\n",
            "#include <string>\nnamespace benchmarks {\nclass Column;\nclass Side : public Base {\n"
            "public:\n    Side();\n};\nenum class Column { left, right };\n}\n"),
        ElementsAre("type benchmarks::Side: a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions(
            "namespace a::b { enum class Mode : int { on }; }",
            "namespace a { inline namespace v1 {} namespace b { struct alignas(16) Mode final {}; "
            "} }"),
        ElementsAre("type a::b::Mode: a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions("struct Loop::Slot { int a; };", "struct Loop::Slot { long a; };"),
        ElementsAre("type Loop::Slot: a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions("template <> struct hash<A> {};", "template <> struct hash<A> {};"),
        ElementsAre("type hash<A>: a.h b.h"));
}

TEST(OneDefinition, AllowsTypesThatAreNotOne) {
    const char* const apart[][2] = {
        {"namespace gate { struct Side {}; }", "namespace viewer { struct Side {}; }"},
        {"namespace n { namespace { struct Side {}; } }", "namespace n { struct Side {}; }"},
        {"namespace { namespace n { struct Side {}; } }", "namespace n { struct Side {}; }"},
        {"class Side;", "class Side {};"},
        {"class Loop { struct Slot {}; };", "class Player { struct Slot {}; };"},
        {"void a() { struct Local {}; }", "void b() { struct Local {}; }"},
        {"template <> struct hash<A> {};", "template <> struct hash<B> {};"},
        {"struct Side side{};", "struct Side* make() { return {}; }"},
        {"struct { int a; } one;", "struct { long a; } other;"},
        {"// struct Side {};", "/* struct\nSide {}; */ struct Side {};"},
        {"const char* text = R\"(\"; struct Side {};)\";", "struct Side {};"}};
    for (const auto& [a, b] : apart)
        EXPECT_THAT(doubleDefinitions(a, b), IsEmpty()) << a << " | " << b;
}

TEST(OneDefinition, FindsTwoFunctionsOfOneName) {
    EXPECT_THAT(
        doubleDefinitions(
            "namespace n { inline double cost(const Side& side, int count = 1) { return 1; } }",
            "namespace n { constexpr double cost(const Side& a, int) { return 2; } }"),
        ElementsAre("function n::cost(const Side&,int): a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions(
            "Side::Side(int a) : name_{a}, text_(\"{\") {}", "Side::Side(int b) : name_(b) {}"),
        ElementsAre("function Side::Side(int): a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions(
            "bool operator==(const A& a, const B& b) { return true; }",
            "inline bool operator==(const A& x, const B& y) { return false; }"),
        ElementsAre("function operator==(const A&,const B&): a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions(
            "template <class T> void sort(std::map<T, int>& all) {}",
            "template <class T> void sort(std::map<T, int>& some) {}"),
        ElementsAre("function sort(std::map<T,int>&) of template<class T>: a.h b.h"));
    EXPECT_THAT(
        doubleDefinitions("inline constexpr double kShare = 0.1;", "inline int kShare{2};"),
        ElementsAre("variable kShare: a.h b.h"));
}

TEST(OneDefinition, AllowsFunctionsThatAreNotOne) {
    const char* const apart[][2] = {
        {"inline int cost(int a) { return a; }", "inline int cost(double a) { return 1; }"},
        {"static int cost(int a) { return a; }", "static int cost(int a) { return 1; }"},
        {"namespace { int cost() { return 1; } }", "namespace { int cost() { return 2; } }"},
        {"int cost(int a);", "int cost(int a) { return a; }"},
        {"struct A { int cost() { return 1; } };", "struct B { int cost() { return 2; } };"},
        {"int A::cost() const { return 1; }", "int A::cost() { return 2; }"},
        {"constexpr int kShare = 1;", "constexpr int kShare = 2;"},
        {"const auto cost = [](int a) { return a; };",
         "const auto cost = [](int a) { return 1; };"}};
    for (const auto& [a, b] : apart)
        EXPECT_THAT(doubleDefinitions(a, b), IsEmpty()) << a << " | " << b;
}

// The reader finds a definition after any of these.
TEST(OneDefinition, ReadsOn) {
    for (const char* const before :
         {"constexpr int kMany[]{1'000, 2};", "const Row kRows[] = {{\"}\", 1}, {\"{\", '}'}};",
          "A::A(int a) : b_{a}, c_(std::move(a)) { if (a) { run(); } }",
          "template <class T, bool B = (sizeof(T) > 4)> void f(T t = {}) {}",
          "#define OPEN {  \\\n    {\n", "extern \"C\" { void f(); }",
          "extern \"C\" char** environ;", "auto f() -> std::vector<int> { return {}; }",
          "TEST(A, B) { run(); }", "template <class T> concept Small = requires(T t) { t.a; };",
          "void A::operator()(int a) const { b(a); }", "using B = A; typedef struct { int a; } C;",
          "double kSmall = 1.5e-3f;", "struct D;", ";"})
        EXPECT_THAT(
            definitionsOf(std::string(before) + "\nstruct Side {};"),
            testing::Contains("type Side"))
            << before;
}

TEST(OneDefinition, SaysWhatItCannotRead) {
    EXPECT_THAT(
        doubleDefinitions("namespace n { struct A {};", "struct B {}; }"),
        ElementsAre("a.h: a bracket has no partner", "b.h: a bracket has no partner"));
}

}  // namespace
