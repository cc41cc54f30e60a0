#include "output/conditioning.h"

#include <gtest/gtest.h>

namespace thermocontact::output {
namespace {

BalanceCondition balance(const std::string& name, double condition) {
    return {name, solve::Condition{condition, 1}};
}

/// 1 / (epsilon 10^6) is 4.5e9.
TEST(Conditioning, FewerThanSixDigitsAreWarnedOf) {
    EXPECT_EQ(warning({balance("momentum", 4.4e9), balance("heat", 10)}), "");
    EXPECT_TRUE(warning({balance("momentum", 4.6e9)}).starts_with("momentum balance: "));
    const std::string both = warning({balance("momentum", 1e12), balance("heat", 1e11)});
    EXPECT_NE(both.find("momentum balance: rounding leaves about 3 digits"), std::string::npos) << both;
    EXPECT_NE(both.find("heat balance: rounding leaves about 4 digits"), std::string::npos) << both;
}

TEST(Conditioning, NothingKnownIsNothingToWarnOf) {
    EXPECT_EQ(warning({{"momentum", {}}}), "");
    EXPECT_TRUE(to_json({{"momentum", {}}})["momentum"].is_null());
    EXPECT_TRUE(to_json({}).empty());
}

}  // namespace
}  // namespace thermocontact::output
