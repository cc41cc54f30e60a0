// Drives a scene step by step until contact carries a given force: step_by_step SCENE.toml BOUNDARY FORCE
// [KEY=VALUE]...
#include <thermocontact/embed/scene_run.h>
#include <thermocontact/error.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    if (argc < 4) {
        std::cerr << "usage: step_by_step SCENE.toml BOUNDARY FORCE [KEY=VALUE]...\n";
        return 2;
    }
    const std::string scene = argv[1], boundary = argv[2];
    const double enough = std::stod(argv[3]);
    try {
        thermocontact::embed::SceneRun run(scene, std::vector<std::string>(argv + 4, argv + argc));
        double force = 0;
        while (force < enough && !run.finished()) {
            run.advance();
            force = run.contact(boundary)["normal_force"];
            const std::vector<double>& theta = run.temperature();
            const auto hottest = std::max_element(theta.begin(), theta.end());
            std::cout << "t = " << run.time() << ", contact force " << force;
            if (hottest != theta.end()) {
                std::cout << ", at most " << *hottest << " K";
            }
            std::cout << "\n";
        }
        std::cout << (force < enough ? "ended" : "reached") << " after step " << run.step() << "\n";
    } catch (const thermocontact::SceneError& error) {
        std::cerr << error.what() << "\n";
        return 2;
    } catch (const thermocontact::NumericsError& error) {
        std::cerr << error.what() << "\n";
        return 3;
    }
}
