#include "output/folder_claim.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "error.h"
#include "support/thread_team.h"

namespace thermocontact::output {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
  protected:
    ~Folder() override { fs::remove_all(folder); }

    const fs::path folder =
        fs::path(testing::TempDir()) / ("thermocontact-claim-" + std::to_string(getpid()) + "-" +
                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    const parallel::Alone alone{};
};

TEST_F(Folder, IsMadeWithItsParents) {
    const FolderClaim claim(folder / "a" / "b", alone);
    EXPECT_EQ(claim.path(), folder / "a" / "b");
    EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
    EXPECT_TRUE(fs::is_empty(folder / "a" / "b"));  // no file says that it is taken
    EXPECT_NO_THROW(claim.require());
}

TEST_F(Folder, GoesWhereItWasMadeAndNothingWritten) {
    fs::create_directories(folder / "there before");
    for (const char* name : {"there before", "made", "written to"}) {
        const FolderClaim claim(folder / name, alone);
        if (name == std::string_view("written to")) {
            std::ofstream(folder / name / "history.csv") << "";
        }
    }
    EXPECT_TRUE(fs::exists(folder / "there before"));
    EXPECT_FALSE(fs::exists(folder / "made"));
    EXPECT_TRUE(fs::exists(folder / "written to"));
}

TEST_F(Folder, CannotBeBelowAFile) {
    fs::create_directories(folder);
    std::ofstream(folder / "file") << "";
    EXPECT_THROW(FolderClaim(folder / "file" / "results", alone), SystemError);
}

TEST_F(Folder, IsOneRunsOnly) {
    {
        FolderClaim first(folder, alone);
        EXPECT_THROW(FolderClaim(folder, alone), SystemError);
        const FolderClaim moved(std::move(first));
        EXPECT_THROW(FolderClaim(folder, alone), SystemError);
    }
    EXPECT_NO_THROW(FolderClaim(folder, alone));
}

TEST_F(Folder, HasToStay) {
    const FolderClaim claim(folder, alone);
    fs::remove(folder);
    EXPECT_THROW(claim.require(), SystemError);
    fs::create_directories(folder);  // another one
    EXPECT_THROW(claim.require(), SystemError);
}

TEST_F(Folder, OfSeveralProcessesIsClaimedByTheFirst) {
    support::ThreadTeam::run(3, [&](const parallel::Team& team) {
        const FolderClaim claim(folder, team);
        EXPECT_NO_THROW(claim.require());
        team.any(false);  // all still have it
        EXPECT_THROW(FolderClaim(folder, team), SystemError);
    });
}

}  // namespace
}  // namespace thermocontact::output
