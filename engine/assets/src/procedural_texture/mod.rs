//! Pictures from parameters: stone, brick, tiles, cloth, plaster and a checker.
