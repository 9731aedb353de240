// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// COLLADA (.dae), read with assimp: all its triangles in one mesh, placed by its scene and scaled by its <unit>. <up_axis> is
// passed over, as RViz does: ROS's robots are drawn with z upwards whatever the file says.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "sdf/mesh_file.hpp"

namespace vsa::reader {

Mesh read_collada(const std::filesystem::path& file) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  constexpr unsigned kMeshesOnly = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                   aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                   aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kMeshesOnly);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType |
                                           aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr)
    throw InputError(Problem{file.string(), "", "", std::string("broken COLLADA: ") + importer.GetErrorString(), ""});
  Mesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v)
      mesh.vertices.emplace_back(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 3)
        mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  return mesh;
}

}  // namespace vsa::reader
