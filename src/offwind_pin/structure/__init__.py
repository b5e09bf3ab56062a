"""From definitions to the chain: sections, frusta, joints, URDF, meshes, the Pinocchio model."""
