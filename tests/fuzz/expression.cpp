/// The expression reader: any bytes as a formula, evaluated where it is accepted.
#include "scene/expression.h"

#include <cmath>

#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace thermocontact;
    const std::string formula = fuzz::as_text(data, size);
    fuzz::answers([&] {
        for (const int dimension : {2, 3}) {
            const scene::Expression expression(formula, dimension);
            try {
                if (!std::isfinite(expression({0.5, 0.25, 2.0}, 1.5))) {
                    __builtin_trap();
                }
            } catch (const NumericsError&) {  // promised where the value is not finite
            }
        }
    });
    return 0;
}
