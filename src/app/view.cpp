#include "app/view.h"

#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "app/exit_code.h"
#include "output/files.h"
#include "view/results_page.h"

namespace thermocontact::app {
namespace {

bool has_screen() {
    return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

/// Asks the desktop for its browser and does not wait; without one the user has the page's name.
void open_in_browser(const std::string& file) {
    std::string program = "xdg-open", page = file;
    char* words[] = {program.data(), page.data(), nullptr};
    pid_t child = 0;
    posix_spawnp(&child, program.c_str(), nullptr, nullptr, words, environ);
}

}  // namespace

int view(const ViewCommand& command) {
    const view::ResultsPage page = view::results_page(command.results);
    output::write_whole(command.page, page.html);
    if (page.shown < page.written) {
        std::cout << page.shown << " of " << page.written << " outputs: all would be too large for a page\n";
    }
    std::cout << command.page.string() << "\n";
    if (command.opens && has_screen()) {
        open_in_browser(std::filesystem::absolute(command.page).string());
    }
    return exit_completed;
}

}  // namespace thermocontact::app
