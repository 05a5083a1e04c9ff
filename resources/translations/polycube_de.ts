<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
  <context>
    <name>Polycube</name>
    <message>
      <source>The analysis that the mesh is for</source>
      <translation>Die Analyse, für die das Netz ist</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>Hexahedral mesh from shape</source>
      <translation>Hexaedernetz aus Form</translation>
    </message>
    <message>
      <source>Hexahedral mesh</source>
      <translation>Hexaedernetz</translation>
    </message>
    <message>
      <source>Mesh parameters</source>
      <translation>Parameter des Netzes</translation>
    </message>
    <message>
      <source>Refinement</source>
      <translation>Verfeinerung</translation>
    </message>
    <message>
      <source>Mesh of the analysis</source>
      <translation>Netz der Analyse</translation>
    </message>
    <message>
      <source>Axes of faces</source>
      <translation>Achsen der Flächen</translation>
    </message>
    <message>
      <source>The direction that each face takes in the block structure of the mesh</source>
      <translation>Die Richtung, die jede Fläche in den Blöcken des Netzes hat</translation>
    </message>
    <message>
      <source>Show on the part</source>
      <translation>Am Bauteil zeigen</translation>
    </message>
    <message>
      <source>Paints each face by its axis; a click on a face gives it another one</source>
      <translation>Färbt jede Fläche nach ihrer Achse; ein Klick auf eine Fläche gibt ihr eine andere</translation>
    </message>
    <message>
      <source>Polycube beside the part</source>
      <translation>Polycube neben dem Teil</translation>
    </message>
    <message>
      <source>Draws what the axes straighten the part into; it takes some seconds more</source>
      <translation>Zeichnet, wozu die Achsen das Teil gerade richten; das dauert einige Sekunden länger</translation>
    </message>
    <message>
      <source>Axes set by hand</source>
      <translation>Von Hand gesetzte Achsen</translation>
    </message>
    <message>
      <source>Automatic</source>
      <translation>Automatisch</translation>
    </message>
    <message>
      <source>Gives up the axes that are selected in the list, all if none is</source>
      <translation>Gibt die Achsen auf, die in der Liste gewählt sind, alle, wenn keine gewählt ist</translation>
    </message>
    <message>
      <source>{} charts, {}, {} turning points, {} CAD edges not captured.</source>
      <translation>{} Felder, {}, {} Wendepunkte, {} CAD-Kanten nicht erfasst.</translation>
    </message>
    <message>
      <source>valid</source>
      <translation>gültig</translation>
    </message>
    <message>
      <source>not valid</source>
      <translation>nicht gültig</translation>
    </message>
    <message>
      <source>No blocks can be made with these axes: give other faces other axes, or make some automatic again.</source>
      <translation>Mit diesen Achsen gibt es keine Blöcke: geben Sie anderen Flächen andere Achsen, oder stellen Sie einige wieder auf automatisch.</translation>
    </message>
    <message>
      <source>{} turns too far for any one axis.</source>
      <translation>{} dreht sich zu weit für eine einzige Achse.</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
    <message>
      <source>Creates a FEM mesh of hexahedra from the selected solid, or from several</source>
      <translation>Erzeugt ein FEM-Netz aus Hexaedern vom gewählten Volumenkörper oder von mehreren</translation>
    </message>
    <message>
      <source>Solve with CalculiX</source>
      <translation>Mit CalculiX lösen</translation>
    </message>
    <message>
      <source>Solves the active analysis with every load on its hexahedra, by elements C3D20R (first order: C3D8I), and loads the results</source>
      <translation>Löst die aktive Analyse mit jeder Last auf ihren Hexaedern, mit Elementen C3D20R (erste Ordnung: C3D8I), und lädt die Ergebnisse</translation>
    </message>
    <message>
      <source>Cancel</source>
      <translation>Abbrechen</translation>
    </message>
    <message>
      <source>Guide to hexahedral meshes</source>
      <translation>Anleitung zu Hexaedernetzen</translation>
    </message>
    <message>
      <source>From a first mesh to stresses, with pictures: refinement, what to do when a part is refused, limits</source>
      <translation>Vom ersten Netz bis zu Spannungen, mit Bildern: Verfeinerung, was zu tun ist, wenn ein Teil abgelehnt wird, Grenzen</translation>
    </message>
    <message>
      <source>Convergence series</source>
      <translation>Konvergenzreihe</translation>
    </message>
    <message>
      <source>Element size</source>
      <translation>Elementgröße</translation>
    </message>
    <message>
      <source>Target cells</source>
      <translation>Zahl der Zellen</translation>
    </message>
    <message>
      <source>Element order</source>
      <translation>Elementordnung</translation>
    </message>
    <message>
      <source>Layers in walls</source>
      <translation>Lagen in Wänden</translation>
    </message>
    <message>
      <source>Round circles</source>
      <translation>Um Kreise</translation>
    </message>
    <message>
      <source>Largest size</source>
      <translation>Größte Länge</translation>
    </message>
    <message>
      <source>Sew faces</source>
      <translation>Flächen vernähen</translation>
    </message>
    <message>
      <source>Directions of X, Y</source>
      <translation>Richtungen von X, Y</translation>
    </message>
    <message>
      <source>Local sizes</source>
      <translation>Lokale Größen</translation>
    </message>
    <message>
      <source>Local refinement</source>
      <translation>Örtliche Verfeinerung</translation>
    </message>
    <message>
      <source>1st</source>
      <translation>1.</translation>
    </message>
    <message>
      <source>2nd</source>
      <translation>2.</translation>
    </message>
    <message>
      <source>From {} to {}{}.</source>
      <translation>Von {} bis {}{}.</translation>
    </message>
    <message>
      <source>Polycube: guide</source>
      <translation>Polycube: Anleitung</translation>
    </message>
    <message>
      <source>{} cells with {} {} to {}. A click shows them alone.</source>
      <translation>{} Zellen mit {} {} bis {}. Ein Klick zeigt sie allein.</translation>
    </message>
    <message>
      <source>Scaled Jacobian</source>
      <translation>Skalierte Jacobi-Determinante</translation>
    </message>
    <message>
      <source>Edge ratio</source>
      <translation>Kantenverhältnis</translation>
    </message>
    <message>
      <source>Skew</source>
      <translation>Schiefe</translation>
    </message>
    <message>
      <source>Warpage</source>
      <translation>Verwindung</translation>
    </message>
    <message>
      <source>Compound of the parts to mesh</source>
      <translation>Verbund der Bauteile zum Vernetzen</translation>
    </message>
    <message>
      <source>Delete</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>Other sizes and numbers of cells at places of the part</source>
      <translation>Andere Größen und Zellenzahlen an Stellen des Bauteils</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>What</source>
      <translation>Was</translation>
    </message>
    <message>
      <source>Where</source>
      <translation>Wo</translation>
    </message>
    <message>
      <source>Value</source>
      <translation>Wert</translation>
    </message>
    <message>
      <source>A tick has the mesh obey; a double click changes the value; the chosen row's places are selected in the 3D view</source>
      <translation>Mit Haken gilt es für das Netz; ein Doppelklick ändert den Wert; die Stellen der gewählten Zeile sind in der 3D-Ansicht markiert</translation>
    </message>
    <message>
      <source>Add</source>
      <translation>Neu</translation>
    </message>
    <message>
      <source>At the faces, edges or vertices that are selected in the 3D view, or solids in the tree</source>
      <translation>An den Flächen, Kanten oder Ecken, die in der 3D-Ansicht gewählt sind, oder Körpern im Baum</translation>
    </message>
    <message>
      <source>Remove</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>From text</source>
      <translation>Aus Text</translation>
    </message>
    <message>
      <source>Makes objects of the text below, as documents of older versions have it</source>
      <translation>Macht Objekte aus dem Text darunter, wie ihn ältere Dokumente haben</translation>
    </message>
    <message>
      <source>Select faces, edges or vertices of the part in the 3D view, then press Add.</source>
      <translation>Wählen Sie Flächen, Kanten oder Ecken des Bauteils in der 3D-Ansicht, dann Neu.</translation>
    </message>
    <message>
      <source>Delete refinement</source>
      <translation>Verfeinerung löschen</translation>
    </message>
    <message>
      <source>Refinements of text</source>
      <translation>Verfeinerungen aus Text</translation>
    </message>
    <message>
      <source>Local size</source>
      <translation>Lokale Größe</translation>
    </message>
    <message>
      <source>Another edge length at faces, at edges at most, or in solids</source>
      <translation>Eine andere Kantenlänge an Flächen, an Kanten höchstens, oder in Körpern</translation>
    </message>
    <message>
      <source>Elements at faces, edges or vertices, and no others, divided by three</source>
      <translation>Elemente an Flächen, Kanten oder Ecken, und keine anderen, werden gedrittelt</translation>
    </message>
    <message>
      <source>Divisions</source>
      <translation>Teilungen</translation>
    </message>
    <message>
      <source>Number of elements along edges</source>
      <translation>Zahl der Elemente entlang von Kanten</translation>
    </message>
    <message>
      <source>Layers</source>
      <translation>Lagen</translation>
    </message>
    <message>
      <source>Number of elements between two opposite faces</source>
      <translation>Zahl der Elemente zwischen zwei gegenüberliegenden Flächen</translation>
    </message>
    <message>
      <source>Elements round a bore</source>
      <translation>Elemente um eine Bohrung</translation>
    </message>
    <message>
      <source>Number of elements round cylindrical faces</source>
      <translation>Zahl der Elemente um zylindrische Flächen</translation>
    </message>
    <message>
      <source>Bias</source>
      <translation>Abstufung</translation>
    </message>
    <message>
      <source>Length of the last element along edges over that of the first</source>
      <translation>Länge des letzten Elements entlang von Kanten zu der des ersten</translation>
    </message>
    <message>
      <source>Faces to keep</source>
      <translation>Flächen, die bleiben</translation>
    </message>
    <message>
      <source>Faces none of whose edges is ignored</source>
      <translation>Flächen, von denen keine Kante übergangen wird</translation>
    </message>
    <message>
      <source>Axis of faces</source>
      <translation>Achse von Flächen</translation>
    </message>
    <message>
      <source>The axis that faces take in the blocks</source>
      <translation>Die Achse, die Flächen in den Blöcken haben</translation>
    </message>
    <message>
      <source>edge ratio</source>
      <translation>Kantenverhältnis</translation>
    </message>
    <message>
      <source>skew</source>
      <translation>Schiefe</translation>
    </message>
    <message>
      <source>warpage</source>
      <translation>Verwindung</translation>
    </message>
    <message>
      <source>Result</source>
      <translation>Ergebnis</translation>
    </message>
    <message>
      <source>No mesh yet</source>
      <translation>Noch kein Netz</translation>
    </message>
    <message>
      <source>What bars, colours, threshold and list judge the cells by</source>
      <translation>Wonach Balken, Farben, Schwelle und Liste die Zellen beurteilen</translation>
    </message>
    <message>
      <source>Quality in colours</source>
      <translation>Qualität in Farben</translation>
    </message>
    <message>
      <source>Paints the mesh as the bars: blue is good, red is bad</source>
      <translation>Färbt das Netz wie die Balken: Blau ist gut, Rot ist schlecht</translation>
    </message>
    <message>
      <source>Blocks in colours</source>
      <translation>Blöcke in Farben</translation>
    </message>
    <message>
      <source>Paints each block of the polycube that the cells divide; a cut shows those inside</source>
      <translation>Malt jeden Block des Polycubes an, den die Zellen teilen; ein Schnitt zeigt die im Inneren</translation>
    </message>
    <message>
      <source>Worse than</source>
      <translation>Schlechter als</translation>
    </message>
    <message>
      <source>Shows the cells beyond this value alone</source>
      <translation>Zeigt nur die Zellen jenseits dieses Werts</translation>
    </message>
    <message>
      <source>No cut</source>
      <translation>Kein Schnitt</translation>
    </message>
    <message>
      <source>Cut X</source>
      <translation>Schnitt X</translation>
    </message>
    <message>
      <source>Cut Y</source>
      <translation>Schnitt Y</translation>
    </message>
    <message>
      <source>Cut Z</source>
      <translation>Schnitt Z</translation>
    </message>
    <message>
      <source>Takes the cells on one side of a plane away, whole</source>
      <translation>Nimmt die Zellen auf einer Seite einer Ebene weg, im Ganzen</translation>
    </message>
    <message>
      <source>Lost CAD edges</source>
      <translation>Verlorene CAD-Kanten</translation>
    </message>
    <message>
      <source>Draws the CAD edges that have no mesh edges in red</source>
      <translation>Zeichnet die CAD-Kanten ohne Netzkanten rot</translation>
    </message>
    <message>
      <source>Cell</source>
      <translation>Zelle</translation>
    </message>
    <message>
      <source>Quality</source>
      <translation>Qualität</translation>
    </message>
    <message>
      <source>At</source>
      <translation>An</translation>
    </message>
    <message>
      <source>The worst cells; a click marks one, a double click looks at it closely</source>
      <translation>Die schlechtesten Zellen; ein Klick markiert eine, ein Doppelklick sieht sie aus der Nähe an</translation>
    </message>
    <message>
      <source>{} lost CAD edges</source>
      <translation>{} verlorene CAD-Kanten</translation>
    </message>
    <message>
      <source>The mesh is out of date: press Apply.</source>
      <translation>Das Netz ist nicht aktuell: Anwenden drücken.</translation>
    </message>
    <message>
      <source>{} cells, {} nodes</source>
      <translation>{} Zellen, {} Knoten</translation>
    </message>
    <message>
      <source>Scaled Jacobian: min {}, mean {}</source>
      <translation>Skalierte Jacobi-Determinante: kleinste {}, Mittel {}</translation>
    </message>
    <message>
      <source>Worst cells: </source>
      <translation>Schlechteste Zellen: </translation>
    </message>
    <message>
      <source>faces</source>
      <translation>Flächen</translation>
    </message>
    <message>
      <source>edges</source>
      <translation>Kanten</translation>
    </message>
    <message>
      <source>vertices</source>
      <translation>Ecken</translation>
    </message>
    <message>
      <source>Of the CAD model: </source>
      <translation>Vom CAD-Modell: </translation>
    </message>
    <message>
      <source>inside</source>
      <translation>innen</translation>
    </message>
    <message>
      <source>{} of {} cells shown</source>
      <translation>{} von {} Zellen gezeigt</translation>
    </message>
    <message>
      <source>No cell is like this: nothing is shown</source>
      <translation>Keine Zelle ist so: nichts wird gezeigt</translation>
    </message>
    <message>
      <source>Von Mises stress</source>
      <translation>Von-Mises-Spannung</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatur</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Verschiebung</translation>
    </message>
    <message>
      <source>{}: {:.4g} (blue) to {:.4g} {} (red). A double click on {} shows more.</source>
      <translation>{}: {:.4g} (blau) bis {:.4g} {} (rot). Ein Doppelklick auf {} zeigt mehr.</translation>
    </message>
    <message>
      <source>Starting the mesher</source>
      <translation>Vernetzer starten</translation>
    </message>
    <message>
      <source>Reading the part</source>
      <translation>Bauteil lesen</translation>
    </message>
    <message>
      <source>Filling the part with tetrahedra</source>
      <translation>Bauteil mit Tetraedern füllen</translation>
    </message>
    <message>
      <source>Choosing axes of faces</source>
      <translation>Achsen der Flächen wählen</translation>
    </message>
    <message>
      <source>Straightening the part into blocks</source>
      <translation>Bauteil zu Blöcken begradigen</translation>
    </message>
    <message>
      <source>Finding the blocks</source>
      <translation>Blöcke finden</translation>
    </message>
    <message>
      <source>Choosing numbers of cells</source>
      <translation>Zahlen der Zellen wählen</translation>
    </message>
    <message>
      <source>Making hexahedra</source>
      <translation>Hexaeder bilden</translation>
    </message>
    <message>
      <source>Adding layers where faces meet</source>
      <translation>Lagen einfügen, wo Flächen aneinanderstoßen</translation>
    </message>
    <message>
      <source>Moving nodes onto the CAD</source>
      <translation>Knoten auf das CAD bringen</translation>
    </message>
    <message>
      <source>Making elements</source>
      <translation>Elemente bilden</translation>
    </message>
    <message>
      <source>Take the best so far</source>
      <translation>Das beste bisher nehmen</translation>
    </message>
    <message>
      <source>Ends the search for a better mesh</source>
      <translation>Beendet die Suche nach einem besseren Netz</translation>
    </message>
    <message>
      <source>Log of the mesher</source>
      <translation>Protokoll des Vernetzers</translation>
    </message>
    <message>
      <source>{} of about {:.0f} s</source>
      <translation>{} von etwa {:.0f} s</translation>
    </message>
    <message>
      <source>Layout {}: {}</source>
      <translation>Aufteilung {}: {}</translation>
    </message>
    <message>
      <source>all CAD edges</source>
      <translation>alle CAD-Kanten</translation>
    </message>
    <message>
      <source>all but {} CAD edges</source>
      <translation>alle CAD-Kanten bis auf {}</translation>
    </message>
    <message>
      <source>Best so far: valid, {}, worst cell {}</source>
      <translation>Bestes bisher: gültig, {}, schlechteste Zelle {}</translation>
    </message>
    <message>
      <source>Count cells</source>
      <translation>Zellen zählen</translation>
    </message>
    <message>
      <source>Finds axes of faces and blocks, but makes no mesh, and says how many cells there will be</source>
      <translation>Sucht Achsen der Flächen und Blöcke, macht aber kein Netz, und sagt, wie viele Zellen es werden</translation>
    </message>
    <message>
      <source>0 is automatic: near to {}</source>
      <translation>0 ist automatisch: etwa {}</translation>
    </message>
    <message>
      <source>about {} cells</source>
      <translation>etwa {} Zellen</translation>
    </message>
    <message>
      <source>{} or more, where edges are short</source>
      <translation>{} oder mehr, wo Kanten kurz sind</translation>
    </message>
    <message>
      <source>up to {}, {} without local sizes</source>
      <translation>bis zu {}, {} ohne lokale Größen</translation>
    </message>
    <message>
      <source>Counting ...</source>
      <translation>Zählt ...</translation>
    </message>
    <message>
      <source>{} cells with these axes and sizes</source>
      <translation>{} Zellen mit diesen Achsen und Größen</translation>
    </message>
    <message>
      <source>Try other axes of faces, or another frame.</source>
      <translation>Versuchen Sie andere Achsen der Flächen oder andere Richtungen von X und Y.</translation>
    </message>
    <message>
      <source>Try other axes of faces, or a finer size.</source>
      <translation>Versuchen Sie andere Achsen der Flächen oder eine feinere Größe.</translation>
    </message>
    <message>
      <source>Try without one of the demands that are named.</source>
      <translation>Versuchen Sie es ohne eine der genannten Forderungen.</translation>
    </message>
    <message>
      <source>Try a finer size, more effort, or give up smooth edges (Feature angle).</source>
      <translation>Versuchen Sie eine feinere Größe, mehr Aufwand, oder geben Sie glatte Kanten auf (Feature-Winkel).</translation>
    </message>
    <message>
      <source>Try a finer size, more effort, or other axes of faces.</source>
      <translation>Versuchen Sie eine feinere Größe, mehr Aufwand oder andere Achsen der Flächen.</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Advanced</source>
      <translation>Weitere</translation>
    </message>
    <message>
      <source>Part:</source>
      <translation>Bauteil:</translation>
    </message>
    <message>
      <source>Analysis:</source>
      <translation>Analyse:</translation>
    </message>
    <message>
      <source>The mesher is running: wait, or stop it with Cancel.</source>
      <translation>Der Vernetzer läuft: warten Sie, oder halten Sie ihn mit Abbrechen an.</translation>
    </message>
    <message>
      <source>The mesher is running already.</source>
      <translation>Der Vernetzer läuft schon.</translation>
    </message>
    <message>
      <source>Nothing has changed since this mesh was made.</source>
      <translation>Seit dieses Netz gemacht wurde, hat sich nichts geändert.</translation>
    </message>
    <message>
      <source>Meshing</source>
      <translation>Vernetzen:</translation>
    </message>
    <message>
      <source>Local sizes make about {} cells of {}: the grid goes through the whole part. Make the mesh?</source>
      <translation>Lokale Größen machen etwa {} Zellen aus {}: das Gitter geht durch das ganze Bauteil. Soll das Netz gemacht werden?</translation>
    </message>
    <message>
      <source>{} holds the mesh {} already. Put the new mesh in its place? The old one stays in the document.</source>
      <translation>{} hat schon das Netz {}. Soll das neue an seine Stelle? Das alte bleibt im Dokument.</translation>
    </message>
    <message>
      <source>Labelling</source>
      <translation>Achsen bestimmen:</translation>
    </message>
    <message>
      <source>there is no part to mesh</source>
      <translation>es gibt kein Bauteil zum Vernetzen</translation>
    </message>
    <message>
      <source>Refused: {}.</source>
      <translation>Abgelehnt: {}.</translation>
    </message>
    <message>
      <source>A finer size</source>
      <translation>Feinere Größe</translation>
    </message>
    <message>
      <source>Other axes of faces</source>
      <translation>Andere Achsen der Flächen</translation>
    </message>
    <message>
      <source>More effort</source>
      <translation>Mehr Aufwand</translation>
    </message>
    <message>
      <source>Smooth edges given up</source>
      <translation>Glatte Kanten aufgeben</translation>
    </message>
    <message>
      <source>the part is gone</source>
      <translation>das Bauteil ist weg</translation>
    </message>
    <message>
      <source>Warning: </source>
      <translation>Warnung: </translation>
    </message>
    <message>
      <source>Meshed: {} cells, {} nodes, worst cell {}.</source>
      <translation>Vernetzt: {} Zellen, {} Knoten, schlechteste Zelle {}.</translation>
    </message>
    <message>
      <source>{} warnings, see the log: {} ...</source>
      <translation>{} Warnungen, siehe Protokoll: {} ...</translation>
    </message>
    <message>
      <source>Taking the mesh</source>
      <translation>Netz übernehmen</translation>
    </message>
    <message>
      <source>The mesh will not have:</source>
      <translation>Das Netz wird nicht haben:</translation>
    </message>
    <message>
      <source>{} more</source>
      <translation>{} weitere</translation>
    </message>
    <message>
      <source>Task panel</source>
      <translation>Aufgaben</translation>
    </message>
    <message>
      <source>Close the open task panel first.</source>
      <translation>Zuerst den offenen Aufgabenbereich schließen.</translation>
    </message>
    <message>
      <source>The mesher is running for this object. Cancel it first.</source>
      <translation>Der Vernetzer arbeitet an diesem Objekt. Zuerst abbrechen.</translation>
    </message>
    <message>
      <source>{} is the mesh of {}. Delete it?</source>
      <translation>{} ist das Netz von {}. Löschen?</translation>
    </message>
    <message>
      <source>Edge length of the hexahedra. Default: by the part, near to bounding-box diagonal / 20.</source>
      <translation>Kantenlänge der Hexaeder. Ohne Angabe: nach dem Bauteil, etwa Diagonale der Hüllbox / 20.</translation>
    </message>
    <message>
      <source>Hexes</source>
      <translation>Hexaeder</translation>
    </message>
    <message>
      <source>Number of hexahedra to come near to, instead of a size.</source>
      <translation>Zahl der Hexaeder, die etwa erreicht werden soll, statt einer Größe.</translation>
    </message>
    <message>
      <source>Coarsest</source>
      <translation>Gröbstes Netz</translation>
    </message>
    <message>
      <source>The fewest hexahedra that keep the part's shape, instead of a size.</source>
      <translation>Die wenigsten Hexaeder, die die Form des Bauteils erhalten, statt einer Größe.</translation>
    </message>
    <message>
      <source>Order</source>
      <translation>Ordnung</translation>
    </message>
    <message>
      <source>Element order: 1 (8 nodes) or 2 (20 nodes, mid-edge nodes on the CAD).</source>
      <translation>Elementordnung: 1 (8 Knoten) oder 2 (20 Knoten, Kantenmittenknoten auf dem CAD).</translation>
    </message>
    <message>
      <source>Element type</source>
      <translation>Elementtyp</translation>
    </message>
    <message>
      <source>Element of .inp files. Default: C3D8 or C3D20 by order.</source>
      <translation>Element von .inp-Dateien. Ohne Angabe: C3D8 oder C3D20 nach der Ordnung.</translation>
    </message>
    <message>
      <source>Effort</source>
      <translation>Aufwand</translation>
    </message>
    <message>
      <source>How many ways are tried where the first gives no good mesh: bounds the work, not the clock.</source>
      <translation>Wie viele Wege versucht werden, wo der erste kein gutes Netz gibt: begrenzt die Arbeit, nicht die Uhr.</translation>
    </message>
    <message>
      <source>quick</source>
      <translation>schnell</translation>
    </message>
    <message>
      <source>normal</source>
      <translation>normal</translation>
    </message>
    <message>
      <source>thorough</source>
      <translation>gründlich</translation>
    </message>
    <message>
      <source>Time limit</source>
      <translation>Zeitgrenze</translation>
    </message>
    <message>
      <source>Stop after this time, with the best mesh so far if there is one. Default: no limit.</source>
      <translation>Nach dieser Zeit aufhören, mit dem besten Netz bisher, wenn es eines gibt. Ohne Angabe: keine Grenze.</translation>
    </message>
    <message>
      <source>Sew</source>
      <translation>Vernähen</translation>
    </message>
    <message>
      <source>Take faces without a solid for one if they sew to it within the file's own tolerance.</source>
      <translation>Flächen ohne Volumenkörper als einen nehmen, wenn sie sich innerhalb der Toleranz der Datei dazu vernähen.</translation>
    </message>
    <message>
      <source>Labels</source>
      <translation>Achsen</translation>
    </message>
    <message>
      <source>Axes of CAD faces set by hand, such as Face3=+X,Face7=-Z.</source>
      <translation>Von Hand gesetzte Achsen von CAD-Flächen, wie Face3=+X,Face7=-Z.</translation>
    </message>
    <message>
      <source>Frame</source>
      <translation>Richtungen</translation>
    </message>
    <message>
      <source>Directions of the labels' X and Y in the part's coordinates, such as 1,0,0/0,1,0. Default: found from the part.</source>
      <translation>Richtungen von X und Y der Achsen in den Koordinaten des Bauteils, wie 1,0,0/0,1,0. Ohne Angabe: aus dem Bauteil.</translation>
    </message>
    <message>
      <source>Min layers</source>
      <translation>Lagen mindestens</translation>
    </message>
    <message>
      <source>Elements through every wall at least. Default: 2 of second order, 3 of first.</source>
      <translation>Elemente durch jede Wand, mindestens. Ohne Angabe: 2 in zweiter Ordnung, 3 in erster.</translation>
    </message>
    <message>
      <source>Per circle</source>
      <translation>Um Kreise</translation>
    </message>
    <message>
      <source>Elements round every full circle at least, arcs in proportion. 0: as the size has it.</source>
      <translation>Elemente um jeden vollen Kreis, mindestens, Bögen im Verhältnis. 0: nach der Größe.</translation>
    </message>
    <message>
      <source>Max size</source>
      <translation>Größte Länge</translation>
    </message>
    <message>
      <source>Edge length that no hexahedron is to exceed. Default: bounding-box diagonal / 15 where no size is given.</source>
      <translation>Kantenlänge, die kein Hexaeder überschreiten soll. Ohne Angabe: Diagonale der Hüllbox / 15, wo keine Größe angegeben ist.</translation>
    </message>
    <message>
      <source>Growth</source>
      <translation>Wachstum</translation>
    </message>
    <message>
      <source>Ratio of the lengths of neighbouring hexahedra, at most, where they grow away from small ones. 1: evenly spaced in every block.</source>
      <translation>Verhältnis der Längen benachbarter Hexaeder, höchstens, wo sie von kleinen weg wachsen. 1: gleichmäßig in jedem Block.</translation>
    </message>
    <message>
      <source>Elements along CAD edges and between opposite CAD faces, such as Edge4=6,Face1-Face2=3.. (at least), ..4 (at most), 2..5; at least through the walls of a solid: Solid2=3..</source>
      <translation>Elemente entlang von CAD-Kanten und zwischen gegenüberliegenden CAD-Flächen, etwa Edge4=6,Face1-Face2=3.. (mindestens), ..4 (höchstens), 2..5; mindestens durch die Wände eines Volumenkörpers: Solid2=3..</translation>
    </message>
    <message>
      <source>Sizes</source>
      <translation>Größen</translation>
    </message>
    <message>
      <source>Other edge lengths at CAD faces, along the labels' axes and of solids, such as Face3=0.5,X=2,Solid2=1.5.</source>
      <translation>Andere Kantenlängen an CAD-Flächen, entlang der Achsen und von Volumenkörpern, etwa Face3=0.5,X=2,Solid2=1.5.</translation>
    </message>
    <message>
      <source>Length of the last hexahedron along a CAD edge over that of the first, such as Edge4=2.0; from its start to its end.</source>
      <translation>Länge des letzten Hexaeders entlang einer CAD-Kante zu der des ersten, wie Edge4=2.0; von ihrem Anfang zu ihrem Ende.</translation>
    </message>
    <message>
      <source>Times that the hexahedra at a CAD face, edge or vertex, and no others, are divided into three along every edge, such as Face7=2,Edge3=1.</source>
      <translation>Wie oft die Hexaeder an einer CAD-Fläche, -Kante oder -Ecke, und nur diese, entlang jeder Kante in drei geteilt werden, etwa Face7=2,Edge3=1.</translation>
    </message>
    <message>
      <source>Interfaces</source>
      <translation>Trennflächen</translation>
    </message>
    <message>
      <source>Where solids touch: one mesh with common nodes (conform), or a mesh of each with nodes of its own, for ties and contact (separate).</source>
      <translation>Wo Volumenkörper sich berühren: ein Netz mit gemeinsamen Knoten (conform), oder von jedem eines mit eigenen Knoten, für Verklebung und Kontakt (separate).</translation>
    </message>
    <message>
      <source>conform</source>
      <translation>gemeinsam</translation>
    </message>
    <message>
      <source>separate</source>
      <translation>getrennt</translation>
    </message>
    <message>
      <source>Feature angle</source>
      <translation>Feature-Winkel</translation>
    </message>
    <message>
      <source>CAD edges that bend less than this are ignored: the faces on both sides share their mesh faces. 0: none.</source>
      <translation>CAD-Kanten mit kleinerem Knick werden übergangen: die Flächen beiderseits teilen sich ihre Netzflächen. 0: keine.</translation>
    </message>
    <message>
      <source>Keep faces</source>
      <translation>Flächen behalten</translation>
    </message>
    <message>
      <source>CAD faces none of whose edges is ignored, such as Face3,Face7. FreeCAD adds those that carry constraints.</source>
      <translation>CAD-Flächen, von denen keine Kante übergangen wird, wie Face3,Face7. FreeCAD fügt die hinzu, die Randbedingungen tragen.</translation>
    </message>
    <message>
      <source>Threads</source>
      <translation>Threads</translation>
    </message>
    <message>
      <source>Threads to use; the mesh does not depend on it. 0: all cores.</source>
      <translation>Zahl der Threads; das Netz hängt nicht davon ab. 0: alle Kerne.</translation>
    </message>
    <message>
      <source>Fidelity</source>
      <translation>Treue</translation>
    </message>
    <message>
      <source>Weight of labels that agree with the surface normal.</source>
      <translation>Gewicht von Achsen, die zur Flächennormale passen.</translation>
    </message>
    <message>
      <source>Compactness</source>
      <translation>Kompaktheit</translation>
    </message>
    <message>
      <source>Weight of short borders between labels.</source>
      <translation>Gewicht kurzer Grenzen zwischen Achsen.</translation>
    </message>
  </context>
</TS>
