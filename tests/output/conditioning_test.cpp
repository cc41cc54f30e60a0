#include "output/conditioning.h"

#include <gtest/gtest.h>

namespace thermocontact::output {
namespace {

BalanceCondition balance(const std::string& name, double condition) {
    return {name, solve::Condition{condition, 1.0}};
}

/// 1 / (epsilon 10^6) is 4.5e9.
TEST(Conditioning, FewerThanSixDigitsAreWarnedOf) {
    EXPECT_EQ(warning({balance("momentum", 4.4e9), balance("heat", 10)}), "");
    EXPECT_TRUE(warning({balance("momentum", 4.6e9)}).starts_with("momentum balance: "));
    const std::string both = warning({balance("momentum", 1e12), balance("heat", 1e11)});
    EXPECT_NE(both.find("momentum balance: rounding leaves about 3 digits"), std::string::npos) << both;
    EXPECT_NE(both.find("heat balance: rounding leaves about 4 digits"), std::string::npos) << both;
}

TEST(Conditioning, BalancesThatAreNotKeptAreWarnedOf) {
    march::Totals totals;
    totals.force_residual = 0.9e-8;
    EXPECT_EQ(warning({balance("momentum", 10)}, totals), "");
    totals.force_residual = 0.17;
    totals.heat_residual = 3e-7;
    const std::string text = warning({balance("momentum", 1e12)}, totals);
    for (const char* words :
         {"3 digits", "force balance: some step keeps it only to 0.17", "; heat balance: "}) {
        EXPECT_NE(text.find(words), std::string::npos) << text;
    }
    EXPECT_EQ(text.find("energy"), std::string::npos) << text;
}

TEST(Conditioning, NothingKnownIsNothingToWarnOf) {
    EXPECT_EQ(warning({{"momentum", {}}}), "");
    EXPECT_TRUE(to_json({{"momentum", {}}})["momentum"].is_null());
    EXPECT_TRUE(to_json({}).empty());
    const auto known = to_json({{"heat", solve::Condition{100, std::nullopt}}})["heat"];
    EXPECT_EQ(known["condition"], 100);
    EXPECT_TRUE(known["contact_condition"].is_null()) << "newton-krylov has no condensed system";
}

}  // namespace
}  // namespace thermocontact::output
