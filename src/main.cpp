/// thermocontact: dynamic frictional contact of a thermo-viscoelastic body with a rigid, heat-conducting
/// foundation.

#include <iostream>
#include <new>

#include "app/check.h"
#include "app/exit_code.h"
#include "app/heap.h"
#include "app/run.h"
#include "error.h"
#include "output/summary.h"
#include "scene/schema.h"

namespace {

using namespace thermocontact;

int execute(const app::RunCommand& command) {
    return app::run(command);
}

int execute(const app::CheckCommand& command) {
    return app::check(command);
}

int execute(const app::SchemaCommand& command) {
    std::cout << scene::print_schema(command.format);
    return app::exit_completed;
}

int execute(const app::VersionCommand&) {
    std::cout << "thermocontact " << output::version_text() << "\n";
    return app::exit_completed;
}

int execute(const app::HelpCommand& command) {
    std::cout << command.text;
    return app::exit_completed;
}

int fail(int code, const std::string& reason) {
    std::cerr << "thermocontact: " << reason << "\n";
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    app::prepare_heap();
    try {
        return std::visit([](const auto& command) { return execute(command); },
                          app::parse_command_line(argc, argv));
    } catch (const SceneError& error) {
        return fail(app::exit_bad_input, error.what());
    } catch (const NumericsError& error) {
        return fail(app::exit_numerics_failed, error.what());
    } catch (const SystemError& error) {
        return fail(app::exit_system_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(app::exit_system_failed, "out of memory; use a coarser mesh or degree");
    } catch (const std::exception& error) {
        return fail(app::exit_system_failed, error.what());
    }
}
