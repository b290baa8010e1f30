//! Contacts with rigid bodies: plane faces, polygons in the plane, triangles of an STL file in space.

use super::fault::{Line, Source};
use super::form::{ContactForm, EndForm, SurfaceForm};
use super::shape::{ends, vector};
use crate::cases::prelude::*;
use crate::files::{DOCUMENT, read};
use mpm_surfaces::Mesh;
use std::sync::Arc;

/// A surface, and the checksum of the file that it is from.
pub(super) type Surface<const D: usize> = (Arc<Mesh<D>>, u32);

/// The surface of a contact; none of a plane face.
///
/// # Errors
/// A surface beside a face, or neither; one that can't be read, or for another number of axes.
pub(super) fn surface<const D: usize>(source: &Source, at: &Line<ContactForm>) -> Result<Option<Surface<D>>, Error> {
    let form = at.get_ref();
    let limited = ends::<3>(&form.within).as_flattened().iter().any(|end| end.is_finite());
    let face = [form.axis.is_some(), form.end.is_some(), form.at_m.is_some()];
    let axes = |kind: &str, allowed: usize| match D == allowed {
        true => Ok(()),
        false => Err(source.at(at, format!("surface: {kind} where the grid has {D} axes; {allowed} are allowed"))),
    };
    match &form.surface {
        None if face == [true; 3] => Ok(None),
        Some(_) if limited || face != [false; 3] => {
            Err(source.at(at, "a surface beside axis, end, at_m or within, where one or the other is allowed"))
        }
        None => Err(source.at(at, "a contact has axis, end and at_m, or a surface")),
        Some(SurfaceForm::Polygon { corners_m }) => {
            axes("polygon", 2)?;
            let corners = corners_m.iter().map(|corner| vector(source, at, "a corner", corner));
            let corners = corners.collect::<Result<Vec<[f64; D]>, _>>()?;
            let sides: Vec<_> = corners.windows(D).map(|side| std::array::from_fn(|k| side[k])).collect();
            Ok(Some((Arc::new(Mesh::new(&sides).map_err(|e| source.at(at, e))?), 0)))
        }
        Some(SurfaceForm::Stl { file }) => {
            axes("stl", 3)?;
            let path = source.beside(at, file)?;
            let bytes = read(&path, DOCUMENT)?;
            let triangles = mpm_surfaces::triangles(&bytes);
            let triangles = triangles.map_err(|e| Error::file(&path, format!("no whole STL file: {e}")))?;
            let corner = |x: &[f64; 3]| -> [f64; D] { std::array::from_fn(|a| x[a]) };
            let facets: Vec<[[f64; D]; D]> =
                triangles.iter().map(|triangle| std::array::from_fn(|k| corner(&triangle[k]))).collect();
            let mesh = Mesh::new(&facets).map_err(|e| Error::file(&path, e))?;
            Ok(Some((Arc::new(mesh), crc32fast::hash(&bytes))))
        }
    }
}

/// The contact, whose velocity is multiplied by `amplitude`.
pub(super) fn contact<const D: usize>(
    form: &ContactForm,
    surface: Option<&Surface<D>>,
    amplitude: Amplitude,
) -> Result<RigidContact<D>, mpm_core::Error> {
    let mut face = match (surface, form.axis, form.at_m) {
        (Some((mesh, _)), ..) => RigidFace::surface(mesh.clone()),
        (None, axis, at) => {
            let end = if matches!(form.end, Some(EndForm::Hi)) { End::Hi } else { End::Lo };
            let face =
                RigidFace::half_space(axis.map_or(D, |axis| axis as usize), end, at.map_or(f64::NAN, |at| at.0))?;
            face.within(ends(&form.within))
        }
    };
    if let Some(velocity) = &form.velocity_m_s {
        face = face.moving(std::array::from_fn(|a| velocity.get(a).map_or(0.0, |v| v.0)), amplitude)?;
    }
    let contact = RigidContact::new(face, Barrier::new(form.stiffness_n_m.0, form.reach_m.0)?);
    Ok(match form.friction {
        None => contact,
        Some(friction) => contact.with_friction(match friction.coefficient {
            Some(mu) => Friction::new(mu.0, friction.stiffness_n_m.0)?,
            None => Friction::rough(friction.stiffness_n_m.0)?,
        }),
    })
}
