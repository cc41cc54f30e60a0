// [forms]: law files in place of built-in laws.

#include <algorithm>
#include <iterator>

#include "error.h"
#include "scene/scene_schema.h"
#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

/// What is a key without a file has no built-in law.
bool is_built_in(const laws::LawFile& file) {
    return !is_key_otherwise(file.kind) &&
           std::ranges::any_of(laws::built_in_laws(), [&](const laws::BuiltIn& law) {
               return law.description.kind == file.kind && law.text == file.text;
           });
}

/// The boundaries whose contact has that law.
std::vector<std::string> users(const Settings& settings, const std::string& kind) {
    return settings.boundaries_with(table_of_law(kind));
}

void check_used(const Settings& settings, const std::string& kind) {
    const std::string table = table_of_law(kind);
    if (!table.starts_with("boundary.")) {
        if (!settings.written(table)) {
            fail_at(settings, "forms." + kind, "the scene has no [" + table + "]");
        }
    } else if (users(settings, kind).empty()) {
        fail_at(settings, "forms." + kind, "no boundary has [" + table + "]");
    }
}

/// A law of the body may be one of bodies in space, say, only.
void check_body(const Settings& settings, const OwnLaw& law, const std::string& body) {
    if (const auto refused = law.description.refused.find(body); refused != law.description.refused.end()) {
        fail_at(settings, "forms." + law.file.kind,
                law.file.path.string() + ":" + refused->second + " (the body: " + body + ")");
    }
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
        if (settings.written("forms." + kind)) {
            check_used(settings, kind);
        }
    }
    for (const OwnLaw& law : settings.laws) {
        check_body(settings, law,
                   settings.body.dimension == 3 ? "space"
                   : is_plane_strain(settings)  ? "plane strain"
                                                : "plane stress");
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
