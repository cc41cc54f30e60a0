#include "app/check.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/exit_code.h"

namespace thermocontact::app {
namespace {

std::string answer(const std::string& scene, const std::vector<std::string>& overrides) {
    testing::internal::CaptureStdout();
    const int code = check({std::filesystem::path(THERMOCONTACT_SCENES) / (scene + ".toml"), overrides});
    EXPECT_EQ(code, exit_completed);
    return testing::internal::GetCapturedStdout();
}

/// What a user reads: the verdict, the paper's label, both sides of an inequality.
TEST(Check, SaysWhatThePaperBreaks) {
    const std::string text = answer("paper", {});
    for (const char* line :
         {"paper.toml: valid\nphysics\n  inertia\n", "\n  s1  = 2.63079 ", "\n  s2  = 0.562454 ",
          "\n  c_k = 0.569271 ", "\n  c_f = 3.51473 ",
          "\n  holds (H2 i)        elasticity elliptic: m_a = 1.81818\n",
          ("\n  FAILS (H3 ii)       conductivity elliptic (heat does not diffuse in every direction): "
           "m_d = 0\n"),
          "\n  FAILS (2.23)        m_a > (L_nu + L_tau) s1^2: m_a = 1.81818, (L_nu + L_tau) s1^2 = 83052.7\n",
          "\n  FAILS (2.23)        m_d > M_kc s2^2: m_d = 0, M_kc s2^2 = 0.316355\n"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << "in\n" << text;
    }
}

TEST(Check, NamesOnlyConstantsThatTheSceneHas) {
    const std::string text = answer("heat-only", {"mesh.cells=[4,4]"});
    EXPECT_EQ(text.find("  s1 "), std::string::npos);
    EXPECT_NE(text.find("  s2 "), std::string::npos);
    EXPECT_NE(text.find("n/a   (H1), (H2)"), std::string::npos);
}

}  // namespace
}  // namespace thermocontact::app
