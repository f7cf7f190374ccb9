// Tests that comments of C++, GLSL and Python follow the rules on sentences in docs/CONTRIBUTING.md
// and are in British spelling.
#include <algorithm>
#include <array>
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

namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kCommented = HAIRBENCH_SOURCE_DIR;

struct Comment {
    std::size_t line = 0;  // first line, from 1
    std::string text;  // lines joined by spaces
};

enum class Language { c, python };

// Reads the comments of a file, and in Python also strings that are statements. Skips other
// literals.
class CommentReader {
public:
    CommentReader(std::string_view text, Language language)
        : text_(text), is_python_(language == Language::python) {}

    std::vector<Comment> comments() {
        while (at_ < text_.size()) step();
        return std::move(comments_);
    }

private:
    bool startsWith(std::string_view what) const { return text_.substr(at_).starts_with(what); }

    // Returns the text up to `end`, and moves past it.
    std::string_view takeUntil(std::string_view end) {
        const std::size_t begin = at_;
        const std::size_t found = std::min(text_.find(end, at_), text_.size());
        at_ = std::min(found + end.size(), text_.size());
        return text_.substr(begin, found - begin);
    }

    // Whether only blanks are before `at_` in its line.
    bool isFirst() const {
        const std::size_t last = text_.substr(0, at_).find_last_not_of(" \t");
        return at_ == 0 || last == std::string_view::npos || text_[last] == '\n';
    }

    void add(std::string_view text, std::size_t line) {
        comments_.push_back({.line = line, .text = ""});
        append(text);
    }

    void append(std::string_view text) {
        std::string& all = comments_.back().text;
        for (const char c : text) {
            const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0;
            if (!is_blank || (!all.empty() && all.back() != ' ')) all += is_blank ? ' ' : c;
        }
    }

    // A comment alone on its line continues the one on the line above, unless that one is empty.
    void lineComment(std::size_t mark) {
        const bool is_alone = isFirst();
        at_ += mark;
        const std::string_view text = takeUntil("\n");
        const bool is_empty = text.find_first_not_of(' ') == std::string_view::npos;
        if (is_alone && !is_empty && last_alone_ == line_ - 1) {
            append(" ");
            append(text);
        } else if (!is_empty) {
            add(text, line_);
        }
        last_alone_ = is_alone && !is_empty ? line_ : kNone;
        ++line_;
    }

    void countLines(std::string_view text) {
        line_ += static_cast<std::size_t>(std::ranges::count(text, '\n'));
    }

    void longText(std::string_view end, bool is_comment) {
        const std::size_t line = line_;
        const std::string_view text = takeUntil(end);
        countLines(text);
        if (is_comment) add(text, line);
    }

    void literal(char quote) {
        for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_)
            if (text_[at_] == '\\') ++at_;
        if (at_ < text_.size() && text_[at_] == quote) ++at_;
    }

    bool isAfterWord() const {
        return at_ > 0 &&
               (std::isalnum(static_cast<unsigned char>(text_[at_ - 1])) || text_[at_ - 1] == '_');
    }

    void step() {
        const char c = text_[at_];
        if (c == '\n') {
            ++line_;
            ++at_;
        } else if (is_python_ ? c == '#' : startsWith("//")) {
            lineComment(is_python_ ? 1 : 2);
        } else if (!is_python_ && startsWith("/*")) {
            at_ += 2;
            longText("*/", true);
        } else if (is_python_ && (startsWith(R"(""")") || startsWith("'''"))) {
            const bool is_statement = isFirst();
            at_ += 3;
            longText(std::string(3, c), is_statement);
        } else if (!is_python_ && c == '"' && at_ > 0 && text_[at_ - 1] == 'R') {
            ++at_;
            longText(')' + std::string(takeUntil("(")) + '"', false);
        } else if (c == '"' || (c == '\'' && (is_python_ || !isAfterWord()))) {
            literal(c);
        } else {
            ++at_;
        }
    }

    static constexpr std::size_t kNone = ~std::size_t{0} - 1;

    std::string_view text_;
    bool is_python_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    std::size_t last_alone_ = kNone;  // line of the last comment that is alone on its line
    std::vector<Comment> comments_;
};

std::vector<std::string> sentencesOf(std::string_view text) {
    std::vector<std::string> sentences(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_end = i > 0 && text[i] == ' ' &&
                            std::string_view(".?!").find(text[i - 1]) != std::string_view::npos;
        if (is_end)
            sentences.emplace_back();
        else if (text[i] != ' ' || !sentences.back().empty())
            sentences.back() += text[i];
    }
    return sentences;
}

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// ---- Sentences ----------------------------------------------------------------------------------

// Beginnings of noun clauses. "That" before a noun begins none: "That point is on the face."
constexpr std::string_view kBeginnings[] = {
    "Of ",         "What ",      "Whose ",     "Such as ",    "That a ",
    "That all ",   "That an ",   "That it ",   "That its ",   "That each ",
    "That every ", "That no ",   "That one ",  "That the ",   "That their ",
    "That there ", "That they ", "That this ", "That these ", "That those "};

// Words that no sentence may have, in this order. The second is empty if one is enough.
constexpr std::array<std::string_view, 2> kWords[] = {
    {"absent of ", ""}, {"but for ", ""},      {"such that ", ""},         {" is what ", ""},
    {" are what ", ""}, {"whose ", " whose "}, {"the one ", " the other"},
};

bool isPlain(const std::string& sentence) {
    if (sentence.ends_with('?')) return true;
    if (std::ranges::any_of(kBeginnings, [&](auto each) { return sentence.starts_with(each); }))
        return false;
    const std::string lower = lowerCase(sentence);
    return std::ranges::none_of(kWords, [&](const auto& words) {
        const std::size_t first = lower.find(words[0]);
        return first != std::string::npos &&
               lower.find(words[1], first + words[0].size() - 1) != std::string::npos;
    });
}

// Returns "line: sentence" for each sentence that breaks the rules.
std::vector<std::string> riddlesIn(std::string_view text, Language language) {
    std::vector<std::string> found;
    for (const Comment& comment : CommentReader(text, language).comments())
        for (const std::string& sentence : sentencesOf(comment.text))
            if (!isPlain(sentence)) found.push_back(std::to_string(comment.line) + ": " + sentence);
    return found;
}

// ---- Spelling -----------------------------------------------------------------------------------

// Reads scripts/british.txt, which scripts/test uses for the pages: "color->colour".
std::map<std::string, std::string> britishWords() {
    std::map<std::string, std::string> words;
    std::ifstream file(kCommented / "scripts/british.txt");
    for (std::string line; std::getline(file, line);) {
        const std::size_t arrow = line.find("->");
        if (arrow != std::string::npos) words[line.substr(0, arrow)] = line.substr(arrow + 2);
    }
    return words;
}

// Whether a sentence cites a work with its year. Titles keep their spelling.
bool namesAWork(const std::string& sentence) {
    static const std::regex year(R"(\b(19|20)\d\d\b)");
    return std::regex_search(sentence, year);
}

// Returns the words of a sentence in lower case, without identifiers and other code.
std::vector<std::string> wordsOf(const std::string& sentence) {
    static const std::regex code("`[^`]*`");
    static const std::regex word(R"(\(?([A-Za-z]+)('s)?[,.;:?!)]*)");
    std::istringstream parts(std::regex_replace(sentence, code, ""));
    std::vector<std::string> words;
    std::smatch match;
    for (std::string part; parts >> part;) {
        if (!std::regex_match(part, match, word)) continue;
        words.push_back(lowerCase(match[1]));
    }
    return words;
}

// Returns "line: word: British word" for each American word.
std::vector<std::string> americanIn(std::string_view text, Language language) {
    static const std::map<std::string, std::string> british = britishWords();
    std::vector<std::string> found;
    for (const Comment& comment : CommentReader(text, language).comments())
        for (const std::string& sentence : sentencesOf(comment.text)) {
            if (namesAWork(sentence)) continue;
            for (const std::string& word : wordsOf(sentence))
                if (const auto better = british.find(word); better != british.end())
                    found.push_back(
                        std::to_string(comment.line) + ": " + word + ": " + better->second);
        }
    return found;
}

// ---- Tests --------------------------------------------------------------------------------------

// Calls check(text, language, path) for the project's files with comments.
template <class Check>
void eachFile(Check&& check) {
    const std::set<std::string> in_c{".c", ".comp", ".cpp",  ".frag", ".geom", ".glsl",
                                     ".h", ".mesh", ".task", ".tesc", ".tese", ".vert"};
    std::size_t count = 0;
    for (const char* const folder :
         {"benchmarks", "docs", "engine", "hair", "scenes", "scripts", "shaders", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(kCommented / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string extension = entry.path().extension().string();
            const bool is_c = in_c.contains(extension);
            if (!is_c && extension != ".py" && !extension.empty()) continue;
            std::ifstream stream(entry.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            const std::string first = text.substr(0, text.find('\n'));
            const bool is_script =
                first.starts_with("#!") && first.find("python") != std::string::npos;
            if (!is_c && extension != ".py" && !is_script) continue;
            ++count;
            check(
                text, is_c ? Language::c : Language::python,
                entry.path().lexically_relative(kCommented));
        }
    EXPECT_GT(count, 1000u);
}

TEST(Comments, HavePlainSentences) {
    eachFile([](const std::string& text, Language language, const fs::path& path) {
        EXPECT_THAT(riddlesIn(text, language), IsEmpty()) << path;
    });
}

TEST(Comments, AreInBritishSpelling) {
    ASSERT_GT(britishWords().size(), 30u);
    eachFile([](const std::string& text, Language language, const fs::path& path) {
        EXPECT_THAT(americanIn(text, language), IsEmpty()) << path;
    });
}

TEST(Comments, OfIdentifiersAndTitlesKeepTheirSpelling) {
    EXPECT_THAT(
        americanIn(
            R"--(// The color's center, (gray) behavior.
int color = 0;  // `color`, color.r, linearColor, /shading/color, color_from, "color", colors[3]
// Okabe and Ito 2008, Color universal design. A fiber: thin.
)--",
            Language::c),
        ElementsAre(
            "1: color: colour", "1: center: centre", "1: gray: grey", "1: behavior: behaviour",
            "3: fiber: fibre"));
}

TEST(Comments, OfCAndGlslAreRead) {
    EXPECT_THAT(
        riddlesIn(
            R"--(// Of two fragments, the nearer one
// is seen. That point is seen.
constexpr int kTwo = 2;  // What is it?
const char* text = "// Of a string", *raw = R"(// Of another)";  // What comes first
int separated = 1'000;  // a number, but for its rest
/* The one goes here,
   and the other there. */
// A head, whose hair covers a neck, whose skin is dark
//
// That the head moves is known.
)--",
            Language::c),
        ElementsAre(
            "1: Of two fragments, the nearer one is seen.", "4: What comes first",
            "5: a number, but for its rest", "6: The one goes here, and the other there.",
            "8: A head, whose hair covers a neck, whose skin is dark",
            "10: That the head moves is known."));
}

TEST(Comments, OfPythonAreRead) {
    EXPECT_THAT(
        riddlesIn(
            R"--("""Whose text this is.

It is plain. That it has two lines is plain, too."""
name = '# What a string has'  # Such as it is
text = """Of a literal
in two lines"""
# This is what a comment says.
)--",
            Language::python),
        ElementsAre(
            "1: Whose text this is.", "1: That it has two lines is plain, too.", "4: Such as it is",
            "7: This is what a comment says."));
}

}  // namespace
