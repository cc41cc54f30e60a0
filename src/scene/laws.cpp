// [forms]: law files in place of built-in laws.

#include <algorithm>
#include <iterator>

#include "error.h"
#include "scene/scene_schema.h"
#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

bool is_built_in(const laws::LawFile& file) {
    return std::ranges::any_of(laws::built_in_laws(), [&](const laws::BuiltIn& law) {
        return law.description.kind == file.kind && law.text == file.text;
    });
}

/// The boundaries whose contact has that law.
std::vector<std::string> users(const Settings& settings, const std::string& kind) {
    return settings.boundaries_with(table_of_law(kind));
}

}  // namespace

std::vector<OwnLaw> laws_of(const Document& document) {
    std::vector<OwnLaw> laws;
    for (const std::string& kind : law_kinds()) {
        const Entry* entry = document.find("forms." + kind);
        if (entry == nullptr) {
            continue;
        }
        const auto name = check_value(*schema().find(entry->key), *entry, 2).get<std::string>();
        const auto path = std::filesystem::path(document.file).parent_path() / name;
        try {
            const laws::LawFile file = laws::read_law_file(kind, path);
            if (!is_built_in(file)) {
                laws.push_back({file, laws::describe(file)});
            }
        } catch (const SceneError& error) {
            fail(entry->where, entry->key + ": " + error.what());
        }
    }
    return laws;
}

std::shared_ptr<const Schema> schema_of(const std::vector<OwnLaw>& laws, const Document& document) {
    if (laws.empty()) {
        return {std::shared_ptr<void>(), &schema()};  // which nobody owns
    }
    std::vector<laws::Description> descriptions;
    std::ranges::transform(laws, std::back_inserter(descriptions), &OwnLaw::description);
    try {
        return schema_with(descriptions);
    } catch (const SceneError& error) {
        fail(document.find("forms")->where, std::string("forms: ") + error.what());
    }
}

std::shared_ptr<const Schema> schema_of_scene(const std::filesystem::path& path,
                                              const std::vector<std::string>& overrides) {
    const Document document = read_document(path, overrides);
    return schema_of(laws_of(document), document);
}

void check_laws(const Settings& settings) {
    for (const std::string& kind : law_kinds()) {
        if (settings.written("forms." + kind) && users(settings, kind).empty()) {
            fail_at(settings, "forms." + kind, "no boundary has [" + table_of_law(kind) + "]");
        }
    }
    if (const OwnLaw* law = settings.law("conductance");
        law != nullptr && law->description.depends_on("p_n")) {
        for (const std::string& name : users(settings, "conductance")) {
            const std::string contact = "boundary." + name + ".contact";
            if (!settings.written(contact + ".compliance")) {
                fail_at(settings, contact + ".conductance",
                        "needs [" + contact + ".compliance], as heat_flux of " + law->file.path.string() +
                            " takes p_n");
            }
        }
    }
    if (const OwnLaw* law = settings.law("friction");
        law != nullptr && law->description.depends_on("speed")) {
        for (const std::string& name : users(settings, "friction")) {
            const std::string key = "boundary." + name + ".contact.friction.regularisation";
            if (settings.has(key) && settings.value(key) == 0) {
                fail_at(settings, key,
                        "expected a number > 0 (m/s), as bound of " + law->file.path.string() +
                            " takes the speed, found " + show(settings.value(key)));
            }
        }
    }
}

}  // namespace thermocontact::scene
