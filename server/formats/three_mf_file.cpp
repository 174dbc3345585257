#include "formats/three_mf_file.h"

#include "core/text.h"
#include "formats/srgb.h"

#include <Model/COM/NMR_DLLInterfaces.h>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace froxel::formats {

namespace {

// Each of lib3mf's objects, to be given back.
struct GiveBack {
    void operator()(NMR::PLib3MFBase* of) const { NMR::lib3mf_release(of); }
};
using Held = std::unique_ptr<NMR::PLib3MFBase, GiveBack>;

constexpr size_t kMostPlaced = size_t{1} << 16U;
constexpr int kMostDepth = 64;

[[noreturn]] void failAt(const std::string& step, NMR::PLib3MFBase* of) {
    ::DWORD code = 0;
    ::LPCSTR text = nullptr;
    const bool told = of != nullptr && NMR::lib3mf_getlasterror(of, &code, &text) == 0 &&
                      text != nullptr && *text != '\0';
    gltf::fail("it is no 3MF file that lib3mf reads: " + step +
               (told ? ": " + printable(text, 200) : ""));
}

// Calls `get(of, ..., &handle)`.
template <class Get, class... Arguments>
Held held(const char* step, NMR::PLib3MFBase* of, Get get, Arguments... arguments) {
    NMR::PLib3MFBase* handle = nullptr;
    if (get(of, arguments..., &handle) != 0 || handle == nullptr) {
        failAt(step, of);
    }
    return Held(handle);
}

template <class Value, class Get>
Value valueOf(const char* step, NMR::PLib3MFBase* of, Get get) {
    Value value{};
    if (get(of, &value) != 0) {
        failAt(step, of);
    }
    return value;
}

double unitOf(NMR::PLib3MFBase* model) {
    switch (valueOf<::DWORD>("unit", model, NMR::lib3mf_model_getunit)) {
    case NMR::MODELUNIT_MICROMETER:
        return 1e-6;
    case NMR::MODELUNIT_CENTIMETER:
        return 1e-2;
    case NMR::MODELUNIT_INCH:
        return 0.0254;
    case NMR::MODELUNIT_FOOT:
        return 0.3048;
    case NMR::MODELUNIT_METER:
        return 1;
    default:
        return 1e-3;
    }
}

glm::mat4 matrixOf(const NMR::MODELTRANSFORM& from) {
    glm::mat4 matrix(1.0F);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            matrix[column][row] = from.m_fFields[row][column];
        }
    }
    return matrix;
}

std::string nameOf(NMR::PLib3MFBase* object) {
    ::ULONG bytes = 0;
    if (NMR::lib3mf_object_getnameutf8(object, nullptr, 0, &bytes) != 0 || bytes == 0 ||
        bytes > 1024) {
        return {};
    }
    std::string name(bytes + 1, '\0');
    if (NMR::lib3mf_object_getnameutf8(object, name.data(), bytes + 1, &bytes) != 0) {
        return {};
    }
    name.resize(name.find('\0') == std::string::npos ? name.size() : name.find('\0'));
    return name;
}

glm::vec4 linear(const NMR::MODELMESHCOLOR_SRGB& color) {
    const glm::dvec3 srgb(color.m_Red, color.m_Green, color.m_Blue);
    return {linearOfSrgb(srgb / 255.0), 1.0F};
}

// The colours of a mesh's triangles.
class Colors {
  public:
    Colors(NMR::PLib3MFBase* model, NMR::PLib3MFBase* mesh)
        : model_(model),
          of_(held("properties", mesh, NMR::lib3mf_meshobject_createpropertyhandler)) {
        Held whole = held("properties", mesh, NMR::lib3mf_object_createdefaultpropertyhandler);
        const auto type = valueOf<NMR::eModelPropertyType>(
            "property", whole.get(), NMR::lib3mf_defaultpropertyhandler_getpropertytype);
        ::DWORD group = 0;
        ::DWORD index = 0;
        NMR::MODELMESHCOLOR_SRGB color{};
        if (type == NMR::MODELPROPERTYTYPE_BASEMATERIALS &&
            NMR::lib3mf_defaultpropertyhandler_getbasematerial(whole.get(), &group, &index) == 0) {
            whole_ = baseColor(group, index);
        } else if (type == NMR::MODELPROPERTYTYPE_COLOR &&
                   NMR::lib3mf_defaultpropertyhandler_getcolor(whole.get(), 0, &color) == 0) {
            whole_ = linear(color);
        }
    }

    // Of its three corners; none: it has no colour of its own, nor has the mesh.
    [[nodiscard]] std::optional<std::array<glm::vec4, 3>> of(::DWORD triangle) {
        NMR::eModelPropertyType type = NMR::MODELPROPERTYTYPE_NONE;
        NMR::lib3mf_propertyhandler_getpropertytype(of_.get(), triangle, &type);
        ::DWORD group = 0;
        ::DWORD index = 0;
        NMR::MODELMESH_TRIANGLECOLOR_SRGB colors{};
        std::optional<glm::vec4> one = whole_;
        if (type == NMR::MODELPROPERTYTYPE_BASEMATERIALS &&
            NMR::lib3mf_propertyhandler_getbasematerial(of_.get(), triangle, &group, &index) == 0) {
            one = baseColor(group, index);
        } else if (type == NMR::MODELPROPERTYTYPE_COLOR &&
                   NMR::lib3mf_propertyhandler_getcolor(of_.get(), triangle, &colors) == 0) {
            return std::array{linear(colors.m_Colors[0]), linear(colors.m_Colors[1]),
                              linear(colors.m_Colors[2])};
        }
        texture_ = texture_ || type == NMR::MODELPROPERTYTYPE_TEXCOORD2D;
        return one ? std::optional(std::array{*one, *one, *one}) : std::nullopt;
    }

    [[nodiscard]] bool hasTexture() const { return texture_; }

  private:
    [[nodiscard]] std::optional<glm::vec4> baseColor(::DWORD group, ::DWORD index) {
        const auto known = base_.find({group, index});
        if (known != base_.end()) {
            return known->second;
        }
        NMR::PLib3MFBase* handle = nullptr;
        std::optional<glm::vec4> color;
        if (NMR::lib3mf_model_getbasematerialbyid(model_, group, &handle) == 0) {
            const Held material(handle);
            NMR::MODELMESHCOLOR_SRGB is{};
            if (NMR::lib3mf_basematerial_getdisplaycolor(handle, index, &is.m_Red, &is.m_Green,
                                                         &is.m_Blue, &is.m_Alpha) == 0) {
                color = linear(is);
            }
        }
        base_.emplace(std::pair(group, index), color);
        return color;
    }

    NMR::PLib3MFBase* const model_;
    Held of_;
    std::optional<glm::vec4> whole_; // of what has none
    std::map<std::pair<::DWORD, ::DWORD>, std::optional<glm::vec4>> base_;
    bool texture_ = false;
};

class Reader {
  public:
    Reader(NMR::PLib3MFBase* from, gltf::Warnings& warnings) : from_(from), warnings_(warnings) {}

    [[nodiscard]] Model read() {
        model_.unit_m = unitOf(from_);
        model_.z_up = true;
        model_.materials.emplace_back();
        model_.materials.emplace_back().base_color = glm::vec4(1.0F); // under colours
        const Held items = held("build items", from_, NMR::lib3mf_model_getbuilditems);
        while (valueOf<::BOOL>("build item", items.get(), NMR::lib3mf_builditemiterator_movenext) !=
               0) {
            const Held item =
                held("build item", items.get(), NMR::lib3mf_builditemiterator_getcurrent);
            const Held object = held("object", item.get(), NMR::lib3mf_builditem_getobjectresource);
            NMR::MODELTRANSFORM transform{};
            const bool moved = valueOf<::BOOL>("transform", item.get(),
                                               NMR::lib3mf_builditem_hasobjecttransform) != 0;
            if (moved) {
                transform = valueOf<NMR::MODELTRANSFORM>("transform", item.get(),
                                                         NMR::lib3mf_builditem_getobjecttransform);
            }
            place(object.get(), moved ? matrixOf(transform) : glm::mat4(1.0F), 0);
        }
        if (model_.placed.empty()) {
            gltf::fail("its build has no triangles; expected a 3MF file with some");
        }
        return std::move(model_);
    }

  private:
    void place(NMR::PLib3MFBase* object, const glm::mat4& transform, int depth) {
        if (++visited_ > kMostPlaced || depth > kMostDepth) {
            gltf::fail("its build places more than " + std::to_string(kMostPlaced) +
                       " objects, or nests them deeper than " + std::to_string(kMostDepth));
        }
        if (valueOf<::BOOL>("object", object, NMR::lib3mf_object_ismeshobject) != 0) {
            const size_t mesh = meshOf(object);
            if (!model_.meshes[mesh].parts.empty()) {
                model_.placed.push_back({mesh, transform});
            }
            return;
        }
        const auto count =
            valueOf<::DWORD>("components", object, NMR::lib3mf_componentsobject_getcomponentcount);
        for (::DWORD i = 0; i < count; ++i) {
            const Held part =
                held("component", object, NMR::lib3mf_componentsobject_getcomponent, i);
            const Held child =
                held("component", part.get(), NMR::lib3mf_component_getobjectresource);
            const bool moved =
                valueOf<::BOOL>("transform", part.get(), NMR::lib3mf_component_hastransform) != 0;
            place(child.get(),
                  moved ? transform *
                              matrixOf(valueOf<NMR::MODELTRANSFORM>(
                                  "transform", part.get(), NMR::lib3mf_component_gettransform))
                        : transform,
                  depth + 1);
        }
    }

    [[nodiscard]] size_t meshOf(NMR::PLib3MFBase* object) {
        const auto id = valueOf<::DWORD>("resource", object, NMR::lib3mf_resource_getresourceid);
        const auto [known, is_new] = by_id_.emplace(id, model_.meshes.size());
        if (is_new) {
            Mesh mesh;
            mesh.name = nameOf(object);
            Part part = partOf(object);
            if (!part.positions.empty()) {
                mesh.parts.push_back(std::move(part));
            }
            model_.meshes.push_back(std::move(mesh));
        }
        return known->second;
    }

    // Three vertices a triangle: colours belong to corners, and every triangle is flat.
    [[nodiscard]] Part partOf(NMR::PLib3MFBase* mesh) {
        const auto vertices =
            valueOf<::DWORD>("vertices", mesh, NMR::lib3mf_meshobject_getvertexcount);
        const auto triangles =
            valueOf<::DWORD>("triangles", mesh, NMR::lib3mf_meshobject_gettrianglecount);
        Colors colors(from_, mesh);
        std::vector<std::optional<std::array<glm::vec4, 3>>> colors_of(triangles);
        bool any = false;
        Part part;
        part.positions.reserve(size_t{triangles} * 3);
        for (::DWORD i = 0; i < triangles; ++i) {
            NMR::MODELMESHTRIANGLE triangle{};
            if (NMR::lib3mf_meshobject_gettriangle(mesh, i, &triangle) != 0) {
                failAt("triangle " + std::to_string(i), mesh);
            }
            for (const ::DWORD index : triangle.m_nIndices) {
                NMR::MODELMESHVERTEX vertex{};
                if (index >= vertices ||
                    NMR::lib3mf_meshobject_getvertex(mesh, index, &vertex) != 0) {
                    failAt("vertex " + std::to_string(index), mesh);
                }
                part.positions.emplace_back(vertex.m_fPosition[0], vertex.m_fPosition[1],
                                            vertex.m_fPosition[2]);
            }
            colors_of[i] = colors.of(i);
            any = any || colors_of[i];
        }
        if (any) {
            const std::array<glm::vec4, 3> none = {model_.materials[0].base_color,
                                                   model_.materials[0].base_color,
                                                   model_.materials[0].base_color};
            part.material = 1;
            for (const auto& of : colors_of) {
                const auto& corners = of ? *of : none;
                part.colors.insert(part.colors.end(), corners.begin(), corners.end());
            }
        }
        if (colors.hasTexture()) {
            warnings_.add(warning::kNotRead, "",
                          "object '" + printable(nameOf(mesh), 240) +
                              "' has textures, which are not read from 3MF files");
        }
        return part;
    }

    NMR::PLib3MFBase* const from_;
    gltf::Warnings& warnings_;
    Model model_;
    std::map<::DWORD, size_t> by_id_;
    size_t visited_ = 0;
};

} // namespace

Model readThreeMf(std::span<const std::byte> file, gltf::Warnings& warnings) {
    NMR::PLib3MFBase* handle = nullptr;
    if (NMR::lib3mf_createmodel(&handle) != 0 || handle == nullptr) {
        throw std::bad_alloc();
    }
    const Held model(handle);
    const Held reader = held("reader", model.get(), NMR::lib3mf_model_queryreader, "3mf");
    // lib3mf does not write there; its interface has no const.
    auto* bytes = const_cast<::BYTE*>(reinterpret_cast<const ::BYTE*>(file.data()));
    if (NMR::lib3mf_reader_readfrombuffer(reader.get(), bytes, file.size()) != 0) {
        failAt("reading", reader.get());
    }
    return Reader(model.get(), warnings).read();
}

} // namespace froxel::formats
