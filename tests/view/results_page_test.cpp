#include "view/results_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "error.h"
#include "view/page_parts.h"

namespace thermocontact::view {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

class ResultsPageTest : public testing::Test {
  protected:
    void SetUp() override {
        if (thermocontact_view_built == 0) {
            GTEST_SKIP() << "built without the page";
        }
        fs::create_directories(folder_ / "fields");
        write(folder_ / "summary.json", R"({"title": "</script>"})");
        write(folder_ / "history.csv", "time\n");
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Outputs whose files have `size` bytes.
    void write_outputs(int count, std::size_t size) {
        std::string collection;
        for (int i = 0; i < count; ++i) {
            const std::string name = "fields/body_" + std::to_string(i) + ".vtu";
            write(folder_ / name, std::string(size, static_cast<char>('a' + i)));
            collection += "<DataSet timestep=\"" + std::to_string(i) + "\" group=\"\" part=\"0\" file=\"" +
                          name + "\"/>\n";
        }
        write(folder_ / "fields.pvd", collection);
    }

    std::string message(std::uintmax_t limit = usual_limit) {
        try {
            results_page(folder_, limit);
            return {};
        } catch (const std::exception& error) {
            return error.what();
        }
    }

    const fs::path folder_ = fs::temp_directory_path() / ("page-" + std::to_string(getpid()));
};

bool holds(const std::string& html, const std::string& text) {
    return html.find(text) != std::string::npos;
}

TEST_F(ResultsPageTest, HoldsEveryFile) {
    write_outputs(3, 10);
    const ResultsPage page = results_page(folder_);
    EXPECT_EQ(page.shown, 3U);
    EXPECT_EQ(page.written, 3U);
    for (const char* text :
         {"data-file=\"fields.pvd\"", "data-file=\"history.csv\">time\n</script>",
          "data-file=\"fields/body_0.vtu\">aaaaaaaaaa</script>", "body_2.vtu\">cccccccccc</script>"}) {
        EXPECT_TRUE(holds(page.html, text)) << text;
    }
    for (const char* mark : {"@STYLE@", "@RESULTS@", "@PROGRAM@", R"({"title": "</script>"})"}) {
        EXPECT_FALSE(holds(page.html, mark)) << mark;
    }
    EXPECT_TRUE(holds(page.html, R"({"title": "<\/script>"})"));
}

TEST_F(ResultsPageTest, LeavesOutWhatIsTooMuchButNotTheEnd) {
    write_outputs(6, 100);
    const ResultsPage page =
        results_page(folder_, 350);  // three outputs: 0, 3 and the last; 0, 2, 4, 5 are four
    EXPECT_EQ(page.shown, 3U);
    EXPECT_EQ(page.written, 6U);
    for (const int kept : {0, 3, 5}) {
        EXPECT_TRUE(holds(page.html, "data-file=\"fields/body_" + std::to_string(kept)));
        EXPECT_TRUE(holds(page.html, "timestep=\"" + std::to_string(kept)));
    }
    for (const int left : {1, 2, 4}) {
        EXPECT_FALSE(holds(page.html, "body_" + std::to_string(left)));
    }
    EXPECT_TRUE(holds(message(99), "view: the fields are too large for a page"));
}

TEST_F(ResultsPageTest, PiecesOfProcesses) {
    write(folder_ / "fields.pvd", R"(<DataSet timestep="0" group="" part="0" file="fields/body.pvtu"/>)");
    write(folder_ / "fields/body.pvtu", R"(<Piece Source="body_p0.vtu"/><Piece Source="body_p1.vtu"/>)");
    write(folder_ / "fields/body_p0.vtu", "first");
    write(folder_ / "fields/body_p1.vtu", "second");
    const std::string html = results_page(folder_).html;
    EXPECT_TRUE(holds(html, "data-file=\"fields/body_p0.vtu\">first<"));
    EXPECT_TRUE(holds(html, "data-file=\"fields/body_p1.vtu\">second<"));
}

TEST_F(ResultsPageTest, FoldersThatHoldNoResults) {
    EXPECT_EQ(message(),
              "view: " + folder_.string() +
                  ": expected a folder of results, with fields.pvd and summary.json, as `run` writes");
    write(folder_ / "fields.pvd", "<Collection></Collection>");
    EXPECT_EQ(message(), "view: " + folder_.string() + ": its fields.pvd names no output");
    write_outputs(2, 10);
    fs::remove(folder_ / "fields/body_1.vtu");
    EXPECT_TRUE(holds(message(), "fields/body_1.vtu: cannot be read: No such file or directory"));
}

}  // namespace
}  // namespace thermocontact::view
