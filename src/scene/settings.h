/// The validated keys of a scene: what was written, and the defaults in force.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "laws/law_file.h"
#include "scene/document.h"
#include "scene/scene.h"
#include "scene/schema.h"

namespace thermocontact::scene {

// NOLINTNEXTLINE(bugprone-exception-escape): the move of JSON is declared noexcept, and nothing in it throws
struct Setting {
    const Key* key = nullptr;
    Location where;        ///< of defaults: the table's place
    nlohmann::json value;  ///< normalised: numbers are double where the type is no integer
};

struct Settings;

/// What the table [mesh] says of the body before anything else can be checked.
struct Body {
    int dimension = 2;
    std::string what = "rectangle";       ///< for messages
    std::vector<std::string> boundaries;  ///< names there are
    std::vector<std::string> regions;
    std::shared_ptr<const mesh::Mesh> mesh = {};  ///< of mesh.file
};

/// A law file that the scene names, and what it says of itself.
struct OwnLaw {
    laws::LawFile file;
    laws::Description description;
};

/// Whether elasticity says so of a body in 2D; a Voigt matrix says nothing of the stress out of the plane.
bool is_plane_strain(const Settings& settings);

/// Reads the files of [forms] but those that are copies of the built-in law; throws SceneError where one
/// cannot be a law, SystemError where that cannot be found out.
std::vector<OwnLaw> laws_of(const Document& document);

/// With the parameters of these laws; throws SceneError where two keys have one name.
std::shared_ptr<const Schema> schema_of(const std::vector<OwnLaw>& laws, const Document& document);

/// Checks that something is made of each law, and that what it depends on is there.
void check_laws(const Settings& settings);

/// Reads mesh.shape or mesh.file; throws SceneError where the file cannot be used.
Body body_of(const Document& document);

struct Settings {
    const Document* document = nullptr;
    Body body;
    std::vector<OwnLaw> laws;                  ///< of files
    std::shared_ptr<const Schema> schema;      ///< with the parameters of these
    std::vector<std::string> boundaries;       ///< written in the scene, alphabetical
    std::vector<std::string> regions;          ///< likewise
    std::map<std::string, Setting> by_name;    ///< keys in force
    std::vector<std::string> in_schema_order;  ///< their names

    const Setting* find(const std::string& name) const;
    bool has(const std::string& name) const { return find(name) != nullptr; }
    const nlohmann::json& value(const std::string& name) const { return by_name.at(name).value; }

    /// Whether a key or table is written in the scene.
    bool written(const std::string& name) const { return document->find(name) != nullptr; }

    /// The law file of that kind, or nullptr: the built-in law.
    const OwnLaw* law(const std::string& kind) const;

    /// Names of the boundaries for which `pattern` (with NAME) exists as key or table.
    std::vector<std::string> boundaries_with(const std::string& pattern) const;

    /// Every key in force as nested tables, in the schema's order; such a file is a scene again.
    nlohmann::ordered_json resolved() const;
};

/// Checks every entry by itself (known key, type, range), then presence, needs and conflicts as the schema
/// declares them. Throws SceneError at the first fault. `document` must outlive the result.
Settings check_document(const Document& document);

/// Checks that involve several keys beyond what the schema can declare.
void check_rules(const Settings& settings);

/// Checks the keys of [mesh.grading], once those of the shape are known to be right.
void check_grading(const Settings& settings);

/// [d]: the ratios of a shape, 1 where the scene gives none.
std::vector<Grading> grading_of(const Settings& settings);

/// Names of the fields that the scene has, in the schema's order.
std::vector<std::string> existing_fields(const Settings& settings);

/// Throws SceneError unless the schema knows `entry` as the key or table that it is, and the body its
/// boundary or region.
void check_known(const Entry& entry, const Schema& schema, const Body& body);

/// The normalised value of a leaf; throws SceneError saying what was expected.
nlohmann::json check_value(const Key& key, const Entry& entry, int dimension);

/// "WHERE: NAME: MESSAGE", where being that of the key or table if it is written.
[[noreturn]] void fail_at(const Settings& settings, const std::string& name, const std::string& message);

/// "WHERE: KEY: expected EXPECTATION, found VALUE", `remark` appended.
[[noreturn]] void fail_value(const Key& key, const Entry& entry, int dimension,
                             const std::string& remark = {});

}  // namespace thermocontact::scene
