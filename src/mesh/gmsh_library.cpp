#include "mesh/gmsh_library.h"

#include <dlfcn.h>
#include <gmshc.h>

#include <memory>
#include <span>
#include <stdexcept>

#include "error.h"
#include "mesh/child.h"
#include "mesh/gmsh_bytes.h"

namespace thermocontact::mesh {
namespace {

std::string soname() {
    return "libgmsh.so." + std::to_string(GMSH_API_VERSION_MAJOR) + "." +
           std::to_string(GMSH_API_VERSION_MINOR);
}

/// Loaded once in a process, and by that in its children.
void* load_library() {
    void* library = dlopen(soname().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        throw SystemError("mesh.file needs the library of Gmsh: " + std::string(dlerror()));
    }
    return library;
}

/// The functions of Gmsh's C interface that reading takes; one session of Gmsh as long as it lives.
class Session {
  public:
    explicit Session(void* library);
    ~Session() {
        int ignored = 0;
        finalize_(&ignored);
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    GmshContents read(const std::filesystem::path& path);

  private:
    template <typename Function>
    void find(const char* name, Function*& function) {
        function = reinterpret_cast<Function*>(dlsym(library_, name));
        if (function == nullptr) {
            throw SystemError(soname() + " has no function " + name);
        }
    }

    /// Calls `function` with `arguments` and the place of the error code; throws Gmsh's message if it failed.
    template <typename Function, typename... Arguments>
    void call(Function* function, Arguments... arguments) {
        int error = 0;
        function(arguments..., &error);
        if (error != 0) {
            char* message = nullptr;
            int ignored = 0;
            last_error_(&message, &ignored);
            throw std::runtime_error(text(message));
        }
    }

    std::string text(char* taken) {
        std::string result = taken == nullptr ? "" : taken;
        free_(taken);
        return result;
    }

    template <typename Value>
    std::vector<Value> list(Value* taken, std::size_t size) {
        std::vector<Value> result(taken, taken + size);
        free_(taken);
        return result;
    }

    void read_nodes(GmshContents& contents);
    void read_groups(GmshContents& contents);
    void read_elements(int dimension, int entity, GmshContents& contents);

    void* library_;
    decltype(&gmshFree) free_;
    decltype(&gmshFinalize) finalize_;
    decltype(&gmshOpen) open_;
    decltype(&gmshOptionSetNumber) set_number_;
    decltype(&gmshLoggerGetLastError) last_error_;
    decltype(&gmshModelGetPhysicalGroups) groups_;
    decltype(&gmshModelGetPhysicalName) group_name_;
    decltype(&gmshModelGetEntitiesForPhysicalGroup) entities_of_;
    decltype(&gmshModelGetEntities) entities_;
    decltype(&gmshModelMeshGetNodes) nodes_;
    decltype(&gmshModelMeshGetElements) elements_;
    decltype(&gmshModelMeshGetElementProperties) properties_;
};

Session::Session(void* library) : library_(library) {
    find("gmshFree", free_);
    find("gmshFinalize", finalize_);
    find("gmshOpen", open_);
    find("gmshOptionSetNumber", set_number_);
    find("gmshLoggerGetLastError", last_error_);
    find("gmshModelGetPhysicalGroups", groups_);
    find("gmshModelGetPhysicalName", group_name_);
    find("gmshModelGetEntitiesForPhysicalGroup", entities_of_);
    find("gmshModelGetEntities", entities_);
    find("gmshModelMeshGetNodes", nodes_);
    find("gmshModelMeshGetElements", elements_);
    find("gmshModelMeshGetElementProperties", properties_);
    decltype(&gmshInitialize) initialize = nullptr;
    find("gmshInitialize", initialize);
    // nothing of the user's own Gmsh configuration may change how a file is read
#if GMSH_API_VERSION_MAJOR == 4 && GMSH_API_VERSION_MINOR < 9
    call(initialize, 0, nullptr, 0);
#else
    call(initialize, 0, nullptr, 0, 0);
#endif
    call(set_number_, "General.Terminal", 0.0);
    call(set_number_, "General.NumThreads", 1.0);
}

void Session::read_nodes(GmshContents& contents) {
    std::size_t *tags = nullptr, tag_count = 0, coordinate_count = 0, parameter_count = 0;
    double *coordinates = nullptr, *parameters = nullptr;
    call(nodes_, &tags, &tag_count, &coordinates, &coordinate_count, &parameters, &parameter_count, -1, -1, 0,
         0);
    contents.node_tags = list(tags, tag_count);
    const std::vector<double> flat = list(coordinates, coordinate_count);
    list(parameters, parameter_count);
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3) {
        contents.points.push_back({flat[i], flat[i + 1], flat[i + 2]});
    }
}

void Session::read_groups(GmshContents& contents) {
    int* pairs = nullptr;
    std::size_t count = 0;
    call(groups_, &pairs, &count, -1);
    const std::vector<int> flat = list(pairs, count);
    for (std::size_t i = 0; i + 1 < flat.size(); i += 2) {
        char* name = nullptr;
        call(group_name_, flat[i], flat[i + 1], &name);
        int* entities = nullptr;
        std::size_t entity_count = 0;
        call(entities_of_, flat[i], flat[i + 1], &entities, &entity_count);
        contents.groups.push_back({flat[i], flat[i + 1], text(name), list(entities, entity_count)});
    }
}

void Session::read_elements(int dimension, int entity, GmshContents& contents) {
    int* types = nullptr;
    std::size_t **tags = nullptr, **nodes = nullptr, *tag_counts = nullptr, *node_counts = nullptr;
    std::size_t type_count = 0, list_count = 0, node_list_count = 0;
    call(elements_, &types, &type_count, &tags, &tag_counts, &list_count, &nodes, &node_counts,
         &node_list_count, dimension, entity);
    for (std::size_t i = 0; i < type_count; ++i) {
        char* name = nullptr;
        int element_dimension = 0, order = 0, node_count = 0, primary_count = 0;
        double* places = nullptr;
        std::size_t place_count = 0;
        call(properties_, types[i], &name, &element_dimension, &order, &node_count, &places, &place_count,
             &primary_count);
        list(places, place_count);
        contents.elements.push_back({dimension, entity, types[i], text(name), list(tags[i], tag_counts[i]),
                                     list(nodes[i], node_counts[i])});
    }
    for (void* taken : {static_cast<void*>(types), static_cast<void*>(tags), static_cast<void*>(nodes),
                        static_cast<void*>(tag_counts), static_cast<void*>(node_counts)}) {
        free_(taken);
    }
}

GmshContents Session::read(const std::filesystem::path& path) {
    call(open_, path.c_str());
    GmshContents contents;
    read_nodes(contents);
    read_groups(contents);
    int* pairs = nullptr;
    std::size_t count = 0;
    call(entities_, &pairs, &count, -1);
    const std::vector<int> flat = list(pairs, count);
    for (std::size_t i = 0; i + 1 < flat.size(); i += 2) {
        read_elements(flat[i], flat[i + 1], contents);
    }
    return contents;
}

}  // namespace

GmshContents read_with_gmsh(const std::filesystem::path& path) {
    // Gmsh's reader crashes on many a damaged file; what a mesh needs is bounded by the size of its file
    constexpr std::uint64_t mebibyte = 1 << 20;
    const std::uint64_t size = std::filesystem::file_size(path);
    const ChildLimits limits{512 * mebibyte + 200 * size, 30 + 10 * size / mebibyte};
    void* library = load_library();
    return from_bytes(run_in_child([&] { return to_bytes(Session(library).read(path)); }, limits));
}

}  // namespace thermocontact::mesh
