// Reads 3MF files by lib3mf 1.8 (Debian lib3mf-dev), in its strict mode, and compares them with their
// NAME.expect (write_samples.cpp): names, numbers of triangles, volumes, colors, and that a closed mesh is
// manifold and oriented to lib3mf. Prints a line for each difference.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "Model/COM/NMR_DLLInterfaces.h"

namespace {

using namespace NMR;

int differences = 0;

void report(const std::string& file, const std::string& what) {
    std::printf("%s: %s\n", file.c_str(), what.c_str());
    ++differences;
}

struct Object {
    std::string name, volume;
    unsigned long triangles = 0;
    bool colored = false;
};

struct Expectation {
    double metres = 0;
    std::vector<Object> objects;
};

Expectation expectation_of(const std::string& path) {
    Expectation expected;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream fields(line);
        std::string kind, count, colored;
        std::getline(fields, kind, '\t');
        if (kind == "unit") fields >> expected.metres;
        if (kind != "object") continue;
        Object object;
        std::getline(fields, object.name, '\t');
        std::getline(fields, count, '\t');
        std::getline(fields, object.volume, '\t');
        std::getline(fields, colored, '\t');
        object.triangles = std::strtoul(count.c_str(), nullptr, 10);
        object.colored = colored == "1";
        expected.objects.push_back(object);
    }
    return expected;
}

std::string name_of(PLib3MFModelObjectResource* object) {
    char buffer[1000] = "";
    ULONG needed = 0;
    lib3mf_object_getnameutf8(object, buffer, sizeof buffer, &needed);
    return buffer;
}

double volume_of(PLib3MFModelMeshObject* mesh, DWORD triangles) {
    double sum = 0;
    for (DWORD i = 0; i < triangles; ++i) {
        MODELMESHTRIANGLE t;
        lib3mf_meshobject_gettriangle(mesh, i, &t);
        MODELMESHVERTEX v[3];
        for (int k = 0; k < 3; ++k) lib3mf_meshobject_getvertex(mesh, t.m_nIndices[k], &v[k]);
        const auto at = [&v](int k, int axis) { return static_cast<double>(v[k].m_fPosition[axis]); };
        for (int axis = 0; axis < 3; ++axis) {
            const int b = (axis + 1) % 3, c = (axis + 2) % 3;
            sum += at(0, axis) * (at(1, b) * at(2, c) - at(1, c) * at(2, b)) / 6;
        }
    }
    return sum;
}

void check_colors(const std::string& file, PLib3MFModelMeshObject* mesh, DWORD triangles, bool colored) {
    PLib3MFPropertyHandler* handler = nullptr;
    if (lib3mf_meshobject_createpropertyhandler(mesh, &handler) != LIB3MF_OK)
        return report(file, "no properties");
    for (DWORD i = 0; i < triangles; ++i) {
        eModelPropertyType type = MODELPROPERTYTYPE_NONE;
        lib3mf_propertyhandler_getpropertytype(handler, i, &type);
        if ((type == MODELPROPERTYTYPE_COLOR) == colored) continue;
        report(file, colored ? "a triangle has no color" : "a triangle has a color");
        break;
    }
    lib3mf_release(handler);
}

void check_object(const std::string& file, PLib3MFModelMeshObject* mesh, const Object& expected) {
    if (name_of(mesh) != expected.name)
        report(file, "name '" + name_of(mesh) + "', not '" + expected.name + "'");
    DWORD triangles = 0;
    lib3mf_meshobject_gettrianglecount(mesh, &triangles);
    if (triangles != expected.triangles) report(file, "triangles: " + std::to_string(triangles));
    BOOL solid = 0, valid = 0;
    lib3mf_meshobject_ismanifoldandoriented(mesh, &solid);
    lib3mf_object_isvalidobject(mesh, &valid);
    if (!valid) report(file, "lib3mf calls an object invalid");
    const bool closed = expected.volume != "-";
    if ((solid != 0) != closed) report(file, closed ? "not manifold and oriented" : "unexpectedly closed");
    DWORD type = 0;
    lib3mf_object_gettype(mesh, &type);
    if (closed && type != MODELOBJECTTYPE_MODEL) report(file, "a closed mesh is not of type model");
    if (closed) {
        const double volume = volume_of(mesh, triangles),
                     wanted = std::strtod(expected.volume.c_str(), nullptr);
        if (!(std::fabs(volume - wanted) <= 1e-6 * std::fabs(wanted)))
            report(file, "volume " + std::to_string(volume) + ", not " + expected.volume);
    }
    check_colors(file, mesh, triangles, expected.colored);
}

void check_unit(const std::string& file, PLib3MFModel* model, double metres) {
    constexpr double lengths[] = {1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1};  // in the order of eModelUnit
    DWORD unit = 0;
    lib3mf_model_getunit(model, &unit);
    if (unit > 5 || lengths[unit] != metres) report(file, "unit " + std::to_string(unit));
}

void check_model(const std::string& file, PLib3MFModel* model, const Expectation& expected) {
    check_unit(file, model, expected.metres);
    PLib3MFModelBuildItemIterator* items = nullptr;
    lib3mf_model_getbuilditems(model, &items);
    std::size_t count = 0;
    for (BOOL more = 0; lib3mf_builditemiterator_movenext(items, &more) == LIB3MF_OK && more; ++count) {
        PLib3MFModelBuildItem* item = nullptr;
        PLib3MFModelObjectResource* object = nullptr;
        lib3mf_builditemiterator_getcurrent(items, &item);
        lib3mf_builditem_getobjectresource(item, &object);
        BOOL is_mesh = 0;
        lib3mf_object_ismeshobject(object, &is_mesh);
        if (count >= expected.objects.size() || !is_mesh) {
            report(file, "an object that is not expected");
        } else {
            check_object(file, object, expected.objects[count]);
        }
        lib3mf_release(object);
        lib3mf_release(item);
    }
    lib3mf_release(items);
    if (count != expected.objects.size()) report(file, std::to_string(count) + " build items");
}

void judge(const std::string& file) {
    PLib3MFModel* model = nullptr;
    PLib3MFModelReader* reader = nullptr;
    if (lib3mf_createmodel(&model) != LIB3MF_OK) return report(file, "lib3mf makes no model");
    lib3mf_model_queryreader(model, "3mf", &reader);
    lib3mf_reader_setstrictmodeactive(reader, 1);
    if (lib3mf_reader_readfromfileutf8(reader, file.c_str()) != LIB3MF_OK) {
        DWORD code = 0;
        LPCSTR message = "";
        lib3mf_getlasterror(reader, &code, &message);
        report(file, "cannot be read: " + std::string(message));
    } else {
        DWORD warnings = 0;
        lib3mf_reader_getwarningcount(reader, &warnings);
        if (warnings != 0) report(file, std::to_string(warnings) + " warnings");
        check_model(file, model, expectation_of(file.substr(0, file.rfind('.')) + ".expect"));
    }
    lib3mf_release(reader);
    lib3mf_release(model);
}

}  // namespace

int main(int count, char** arguments) {
    for (int i = 1; i < count; ++i) judge(arguments[i]);
    std::printf("%d files read by lib3mf, %d differences\n", count - 1, differences);
    return count > 1 && differences == 0 ? 0 : 1;
}
